"""Force elements: loads, springs and cylinders on a mechanism, declared like its points. Forces in N, gravity downwards.

positive thrust pushes the ends of the driven length apart     A o--->[=====]<---o B   the pins push back
a weight pulls down, a spring longer than its free length pulls its ends together
a moment turns its link counter-clockwise; a support pushes its point along its direction
"""

from ..star import declare_public
from .acting import (
    OWN_LOADS,
    PLAIN,
    PLAIN_CASE,
    Acting,
    ActingKeywords,
    Case,
    HasLoads,
    LoadCase,
    Loads,
    StrokeRates,
    case_in_words,
    case_title,
    case_titles,
    situation_of,
    takes_situation,
)
from .element import (
    AS_IT_RUNS,
    AT_REST,
    DIRECTIONS,
    FRICTIONLESS,
    SENSES,
    Declared,
    ForceElement,
    Friction,
    Glyph,
    LawElement,
    Load,
    Parameter,
    Poses,
    Push,
    Rate,
    Rates,
    Reeving,
    Share,
    Tie,
    TwoPinned,
    check_together,
    couple,
    require_poses,
)
from .point import Force, GuideFriction, LinkMass, Moment, PinFriction, Support, Weight
from .rope_path import Pulley, RopePath
from .two_point import Actuator, Between, Damper, DrawnAs, Halves, Spring, TwoPoint

declare_public(globals())
