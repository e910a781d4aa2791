"""A cam and its roller follower: a step of one's own, in one class."""

from collections.abc import Sequence
from math import pi

import numpy as np

from linkage import Curve
from linkage.quantities import Joint, JointSide, guided, label, name_of, quantity, source_text
from linkage.steps import Contour, Point
from linkage.vectors import Line, Vec


class RollerCam(Point):
    """The centre of a roller that slides on a guide, lifted by a cam: `R = RollerCam(O, A, rail, base=r0, angles=..., lifts=...)`.

    The cam turns about O with the body OA; its angle [rad] is counted from the guide's direction to O -> A. The roller's centre stands at
    `base` + lift [m] from the guide's origin, the lift by a periodic cubic spline through the table, so that it has no jumps in the
    acceleration. O and the guide belong to one body; `roller` is the roller's radius [m]. Source: Norton, "Cam Design", chapter 7.
    """

    expects = (("O", "point"), ("A", "point"), ("guide", "guide"), ("base", "quantity"))

    def __init__(self, O, A, guide, *, base, angles: Sequence[float], lifts: Sequence[float], roller: float = 0.01):
        self.O, self.A, self.guide, self.base = O, A, guide, quantity(base)
        self.angles, self.lifts, self.roller = list(angles), list(lifts), roller
        self.lift = Curve(self.angles, self.lifts, period=2 * pi, name="lift")

    def parts(self):
        return self.O, self.A, self.guide, self.base

    def lengths(self):
        return (self.base,)

    def along(self, where):
        """Return the guide's line and the cam's angle."""
        line, arm = where.line(self.guide), where.direction(name_of(self.O), name_of(self.A))
        return line, np.arctan2(line.direction.cross(arm), line.direction.dot(arm))

    def place(self, where):
        line, angle = self.along(where)
        return line.at(where.value(self.base) + where.curve(self.lift, angle))

    def tangent(self, where):
        """Return the line along which the roller's centre moves over the cam; the cam pushes it to its left."""
        (line, angle), R = self.along(where), where.at(self.name)
        way = line.direction * where.curve(self.lift, angle, order=1) - (R - where.at(self.O)).left()
        return Line(R, way * (1.0 / way.length()))

    def joints(self):
        """Return the guide, across which it holds, and the cam, which only pushes along the normal of its profile."""
        cam = JointSide((name_of(self.O), name_of(self.A)))
        return guided(self.name, name_of(self.guide)), Joint("cam", self.name, JointSide((self.name,)), cam, "n", self.tangent, pushes=True)

    def outline(self, where):
        """Return the cam's profile, a roller's radius inside the path of the roller's centre, and the roller."""
        line, angle = where.line(self.guide), np.linspace(0.0, 2 * pi, 181)
        away = line.origin - where.at(self.O)
        centre = Vec(line.direction.dot(away) + where.value(self.base) + self.lift(angle), line.direction.cross(away) + 0.0 * angle)
        normal = Vec(centre.x, centre.y + self.lift(angle, order=1))
        profile = (centre - normal * (self.roller / normal.length())).turned(np.cos(angle), -np.sin(angle))
        round_ = self.roller * np.array([np.cos(angle), np.sin(angle)])
        O, A = name_of(self.O), name_of(self.A)
        return Contour(O, A, np.stack([profile.x, profile.y])), Contour(self.name, O, round_)

    def __str__(self):
        given = f"base={source_text(self.base)}, angles={self.angles}, lifts={self.lifts}, roller={self.roller!r}"
        return f"RollerCam({label(self.O)}, {label(self.A)}, {label(self.guide)}, {given})"
