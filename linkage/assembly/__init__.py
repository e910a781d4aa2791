"""Pins, links and slides turned into steps; groups solved and continued along the stroke."""

from .assemble import assembled as assembled
from .following import NONE_SOLVED as NONE_SOLVED
from .following import parted as parted
from .following import with_angles as with_angles
from .groups import Solved as Solved
from .groups import solve_groups as solve_groups
from .modes import Assembly as Assembly
from .modes import assemblies as assemblies
from .newton import Newton as Newton
from .sketch import places_at as places_at
