"""Where everything is over the stroke: positions, ratios, angles, distances."""

from .evaluation import PoseFunction, evaluate, evaluate_grid, source_of
from .extremes import Extremum, Span, below_zero, greatest, lowest, reached
from .featured import Featured
from .gaps import gap
from .grid import Grid
from .judging import Judging, added_verdicts, geometry_verdicts, member_verdicts, motion_verdicts
from .limits import stroke_display_unit, stroke_unit
from .live import LiveText, live_text
from .motion import Motion, OnePose, Target, each_at_its_stroke, out_of_reach, require_motion
from .peaks import highest, last_holding
from .poles import whole_body
from .pose_requests import condition, transmission
from .requests import BoundRequest, Ratio, Request, RequestLike, Value, ratio
from .strokes import at_values, check_any, float_array, rates_of, sweep_values
from .table import Column, Tabled, columns_of
