"""Machines at work on one pump each, which their cylinders share, and a press that comes down fast by the oil of its rod.

The pumps and the cycles are illustrative; what stands on them is as it is shipped.
"""

from __future__ import annotations

from hydraulics import Cylinder, LiftCircuit, OilLine, Pump, Relief
from linkage import Featured, Ground, Guide, Mechanism, OnGuide, Outline, Over, Part, Spring, Stroke, Weight, deg, ramp
from linkage.units import bar, litre, minute, mm

from ..crane import Crane
from .excavator import Arm, Boom, Bucket, Excavator
from .forwarder import Forwarder
from .telehandler import Forks, Telehandler


class PumpedExcavator(Excavator):
    """The excavator on one pump of 45 l/min and 5.75 kW. It swings its full bucket up in a cycle that asks for most of the pump's flow."""

    grading, loading = None, None  # type: ignore[assignment]
    supply = Pump(200 * bar, flow=45 * litre / minute, power=5750.0)

    boom = Part(Boom, S="lift", line=None)
    arm = Part(Arm, S="swing", on=("boom.B", "boom.A"), A="boom.A", E="boom.E", line=None)
    tool = Part(Bucket, S="curl", on=("arm.A", "arm.L"), G="arm.G", J="arm.J", L="arm.L", line=None)
    boom_line = LiftCircuit("boom.ram", supply, relief=230 * bar)
    arm_line = LiftCircuit("arm.ram", supply, relief=230 * bar)
    tool_line = LiftCircuit("tool.ram", supply, relief=230 * bar)

    cycle = Over.path(
        lift=ramp(0.100, 0.300, speed=0.06, acceleration=0.3), swing=ramp(0.400, 0.200, speed=0.06, acceleration=0.3),
        curl=ramp(0.155, 0.400, speed=0.06, acceleration=0.3), cases=["carrying"],
    )  # fmt: skip


class PumpedTelehandler(Telehandler):
    """The telehandler on one pump of 90 l/min, 20 bar above the greatest need; the lift is served first."""

    stacking, reaching = None, None  # type: ignore[assignment]
    supply = Pump(240 * bar, flow=90 * litre / minute, power=25 * 1e3, margin=20 * bar, first=["ram"])

    forks = Part(Forks, S="tilt", on=("O", "T"), Q="Q", N="N", line=None)
    lift_line = LiftCircuit("ram", supply, relief=260 * bar)
    push_line = LiftCircuit("push", supply, relief=260 * bar)
    tilt_line = LiftCircuit("forks.ram", supply, relief=260 * bar)

    cycle = Over.path(
        lift=ramp(0.0, 0.5, speed=0.055, acceleration=0.1), extend=ramp(0.0, 0.6, speed=0.08, acceleration=0.1),
        tilt=ramp(0.056, 0.240, speed=0.020, acceleration=0.04), cases=["far"],
    )  # fmt: skip


class PumpedForwarder(Forwarder):
    """The forwarder's crane on one pump of 120 l/min, least pressure first: light movements go before heavy ones."""

    loading, opening = None, None  # type: ignore[assignment]
    supply = Pump(
        220 * bar, flow=120 * litre / minute, mechanical_efficiency=0.95, power=45e3, margin=18 * bar, sharing="least pressure first"
    )

    crane = Part(Crane, phi="phi", psi="psi", t="t", stems=None, lift_line=None, fold_line=None, extend_line=None)
    lift_line = LiftCircuit("crane.lift", supply, relief=240 * bar)
    fold_line = LiftCircuit("crane.fold", supply, relief=240 * bar)
    extend_line = LiftCircuit("crane.extend", supply, relief=240 * bar)

    cycle = Over.path(
        phi=ramp(45 * deg, 20 * deg, speed=5 * deg, acceleration=15 * deg),
        psi=ramp(80 * deg, 30 * deg, speed=8 * deg, acceleration=25 * deg),
        t=ramp(0.9, 0.0, speed=0.15, acceleration=0.5), swing=0.0, theta=-40 * deg, twin=-40 * deg, cases=["plain"],
    )  # fmt: skip


class RegenerativePress(Mechanism):
    """Cylinder OB presses a ram down on a spring of 300 N/mm, both of its sides on one line.

    Its rod's oil goes back to the piston, so that it is as fast as the rod alone would be, and as weak. Known for: presses close so.
    """

    S = Stroke(0.0, 0.250)  # m

    O, X, W = Ground(0.0, 1.200), Ground(0.0, 0.0), Ground(0.0, -0.100)
    way = Guide(O, X)
    B = OnGuide(way, at=0.600 + S)

    ram = Cylinder(O, B, bore=100 * mm, rod=70 * mm, closed=0.600, stroke=0.250)
    supply = Pump(210 * bar, flow=30 * litre / minute, power=7.5 * 1e3)
    valve = Relief(200 * bar)
    line = OilLine(ram.piston_side, ram.rod_side, supply, valve)
    steel = Weight(B, mass=150.0)
    work = Spring(B, W, stiffness=300e3, free_length=0.710)  # pressed from the start, so that it carries the tool

    closing = Over.path(S=ramp(0.0, 0.200, speed=0.10, acceleration=0.5))

    table = Outline([(-0.4, -0.10), (0.4, -0.10), (0.4, -0.25), (-0.4, -0.25)])

    about = Featured("B_y", ["B"])
