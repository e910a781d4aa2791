"""Scalars of a mechanism: strokes, dimensions, outputs, and arithmetic of them."""

import warnings

from ..star import declare_public
from .axes import FRAME_AXES, Axes, is_nothing
from .course import Course, course_of, ramp
from .curve import Curve, CurveValue
from .inputs import Dimension, Stroke, Variable
from .joint import FRAME_SIDE, Driven, Joint, Jointed, JointSide, guided, pinned
from .member import (
    Member,
    NamedMembers,
    Reference,
    Tabulated,
    Turning,
    Where,
    as_mapping,
    body_name,
    is_member_or_name,
    is_name,
    joined_names,
    keywords,
    name_of,
    needed_behind,
    needs,
    of_kind,
    unnamed,
)
from .outputs import Angle, AtPose, Coordinate, Distance, InnerQuantity, Length, angle, distance, label, x, y
from .quantity import (
    TAKEN,
    Arithmetic,
    Function,
    Negative,
    Number,
    Operand,
    Operation,
    PoseCondition,
    Quantity,
    Ref,
    Sum,
    in_degrees,
    is_number,
    is_whole,
    numbers_in,
    quantity,
    real,
    ref,
    signed_terms,
    source_text,
)

declare_public(globals())


def __getattr__(name: str) -> object:
    """Return `source_text` by its former name, with a warning; AttributeError for any other name."""
    if name != "spelled":
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    warnings.warn("linkage.quantities.spelled is source_text now; the old name goes with the next release.", FutureWarning, stacklevel=2)
    return source_text
