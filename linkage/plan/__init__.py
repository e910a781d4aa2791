"""The ordered steps, their dimensions, and their program."""

from ..star import declare_public
from .chain import ChainBody, KinematicChain, Pair, arm_joint, arm_points, holds_an_arm, strokes_alone
from .members import (
    Body,
    as_written,
    carrying_pairs,
    member_sides,
    merged,
    needed_names,
    printed,
    spanning_name,
    strokes_text,
    with_inner,
    written_out,
)
from .missing import WIDE, Mask, failures, missing_words, name_or_pins, negative, opening
from .part import Part, check_circuits, has_no_axes, with_parts
from .plan import TRACING, Plan, plan_measure, require_kind, require_kinds
from .reading import ArrayReading, Reading
from .table import DesignVariable, Table
from .trace import NEAR, REGULAR, Guard, Loop, Nearness, Trace, rate_name

declare_public(globals())
