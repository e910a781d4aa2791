"""Where everything is over the stroke: positions, ratios, angles, distances."""

from ..numeric import highest, last_holding
from ..star import declare_public
from .answer import Answer, LostPlaces
from .follow import follow_path
from .functions import PoseFunction, evaluate, evaluate_grid, source_of
from .gaps import gap, nearest_places
from .grid import Grid
from .instants import Instants
from .judge import Judge, Question, case_named, judge_along
from .limits import drive_kind, places_text, stroke_display_unit, stroke_measure, stroke_unit, way_text
from .live import LiveText, live_text
from .measures import Condition, Constraint, Leaf, Measure, at, integral, least, most, reachable, worst
from .motion import Motion, OnePose, each_at_its_stroke, require_motion
from .motion_verdicts import HasVerdicts, PageWords, geometry_verdicts, judge_verdicts, judged_poses, limits_over, over_time, pose_sentence
from .over import OPTIONS, Over, Run
from .places import Positions, Target, positions_for
from .planes import Planes, clearance, nearest_gap, pair_at, pairs_without_planes
from .poles import whole_body
from .regions import inside, outside
from .requests import MotionFunction, NodeRequest, Request, RequestLike, SmoothPiece, Value, condition, ratio, transmission
from .search import Span, below_zero, greatest, lowest, reached_spans
from .stroke_search import out_of_reach
from .strokes import at_values, check_any, float_array, rates_of, sweep_values
from .table import Column, Featured, Tabled, columns_of, from_above, speakers

declare_public(globals())
