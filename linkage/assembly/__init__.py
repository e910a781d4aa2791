"""Pins, links and slides turned into steps; groups solved and continued along the stroke."""

from ..star import declare_public
from .angle_continuation import NONE_SOLVED, ambiguous_angle, with_angles
from .assemble import assembled, chain_parts
from .groups import GroupSolution, solve_groups
from .live import angles_text, constants_text, groups_text, json_of
from .modes import Assembly, assemblies, members_on_sides
from .newton import Newton, lost_at_sketch
from .sketch import places_at, places_drawn, sketch_words, width_words

declare_public(globals())
