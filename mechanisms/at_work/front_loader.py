"""The front loader of the classic linkages at work: its cylinders, their circuits, what it weighs and lifts. Figures: illustrative."""

from __future__ import annotations

from hydraulics import Cylinder, LiftCircuit
from linkage import LinkMass, LoadCase, Over
from linkage.units import bar, mm

from ..classics.front_loader import FrontLoader


class LoadedFrontLoader(FrontLoader):
    """The self-levelling front loader with two cylinders KL and two cylinders MT: 800 kg in the bucket, which the parallelograms carry.

    `lifting` takes the load up with the bucket level, `dumping` tips it out, `returning` comes down empty.
    """

    boom_mass = LinkMass(("O", "B"), mass=180.0, at=(1.3, 0.1))
    bucket_mass = LinkMass(("B", "N"), mass=160.0, at=(0.35, 0.15))
    load = LinkMass(("B", "N"), mass=800.0, at=(0.45, 0.25))
    rams = Cylinder("K", "L", bore=80 * mm, rod=45 * mm, count=2, closed=1.0, stroke=0.6)
    tilt_rams = Cylinder("M", "T", bore=63 * mm, rod=36 * mm, count=2, works="both", closed=0.7, stroke=0.35)
    lift_line = LiftCircuit(rams, pressure=180 * bar, relief=200 * bar)
    tilt_line = LiftCircuit(tilt_rams, pressure=180 * bar, relief=200 * bar)

    empty = LoadCase("empty", scale={"load": 0.0})
    lifting = Over.path(lift=[0.0, 0.6], tilt=0.0, cases=["plain"])
    dumping = Over.path(lift=0.6, tilt=[0.0, 0.30], cases=["plain"])
    returning = Over.path(lift=[0.6, 0.0], tilt=0.0, cases=["empty"])
