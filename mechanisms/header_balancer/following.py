"""Shoe, pressures and reactions over the stroke. Forces are those of `linkage.statics`; pressures gauge [Pa]."""

from __future__ import annotations

from functools import cached_property
from typing import Any

import numpy as np

from hydraulics import Cylinder, FloatCircuit, pressure
from linkage import Column, DefinitionError, ForceElement, GuideFriction, Motion, drive_force, driving_force, most, ratio, reaction, ref
from linkage.errors import ensure, require_whole
from linkage.frozen import record
from linkage.language import noted
from linkage.loads import SENSES, Acting, PinFriction, Support
from linkage.loads.element import Formulas
from linkage.motion import Answer, MotionFunction, require_motion
from linkage.program import FloatArray
from linkage.quantities import Coordinate, Distance
from linkage.units import mm, require_number, show

from ..paper import answers_over, own_loads

AB = Distance("A", "B")  # one for all, so that its ratio is worked out once

LINE, SHOE, BEARING = "floating", "shoe", "pin_O"
"""The members with a part of their own: the charged line, the support under the shoe, the friction at O. Every other load counts alike."""

PLAIN = 0.15
"""Friction coefficient of the plain bearing at O that the paper looks at; a rolling bearing has none worth counting."""

REACHED = 1e-9  # m
MANY = 10_000_000  # poses


def stroke_at(height: Any, O_y: Any, OA: Any, to_A: Any, L_OB: Any, L_OR: Any, BOR: Any, L_min: Any) -> Any:
    """Return the stroke at which the shoe R stands at a height [m]: (4)-(16) backwards. Numbers, arrays or quantities.

    OA is a length [m], to_A the direction O -> A, BOR the angle from OB to OR [rad]; R lies to the right of O.
    """
    drop = height - O_y
    to_R = np.arctan2(drop, np.sqrt(L_OR * L_OR - drop * drop))
    AOB = to_R - BOR - to_A
    return np.sqrt(OA * OA + L_OB * L_OB - 2.0 * (OA * (L_OB * np.cos(AOB)))) - L_min


def stroke_of(motion: Motion, height: float) -> float:
    """Return the stroke [m] at which the shoe of one design stands at a height [m]; DefinitionError where it never does."""
    require_header(motion)
    require_number("height", height, "one number in m is expected, above the horizon", kind="length")
    ensure(not motion._design_shape, "The following range is found for one design at a time; this motion has a batch of them.")
    given = motion.inputs
    with np.errstate(all="ignore"):
        x, y = given["A.x"] - given["O.x"], given["A.y"] - given["O.y"]
        angles_and_lengths = np.arctan2(y, x), given["L_OB"], given["L_OR"], given["BOR"], given["L_min"]
        h = float(stroke_at(height, given["O.y"], np.hypot(x, y), *angles_and_lengths))
    low, high = sorted((motion.plan.strokes["h"].start, motion.plan.strokes["h"].end))
    stands = height_at(motion, h) if low <= h <= high else np.nan
    wide = f"that is at h = {h / mm:.1f} mm, the stroke is {low / mm:.1f} to {high / mm:.1f} mm"
    why = f"{'it never comes there' if np.isnan(h) or low <= h <= high else wide}. Follow less, or change L_min or BOR"
    ensure(abs(stands - height) < REACHED, f"The shoe cannot be {height / mm:+.0f} mm from the horizon: {why}.")
    return h


def height_at(motion: Motion, h: float) -> float:
    """Return the height [m] at which the shoe of one design stands at a stroke [m]."""
    return float(motion.moved({"h": np.array([h])}).y("R")[0])


def require_header(motion: Motion) -> None:
    """Raise DefinitionError for anything but a motion of a balanced header."""
    require_motion(motion)
    if "follows" not in motion.inputs or "h" not in motion.strokes:
        raise DefinitionError(f"{motion.plan.title} is no balanced header; give a motion of a HeaderBalancer.")


def over_following(motion: Motion, count: int = 101) -> Motion:
    """Return the same design over the following range, from the shoe's lowest place to its highest, equally spaced in h.

    Parameters
    ----------
    motion : Motion
        The poses.
    count : int, optional
        The number of poses.

    Returns
    -------
    Motion
        The motion.
    """
    require_header(motion)
    require_whole("count", count, "a whole number of poses is expected, such as 101", least=1, most=MANY)
    range_ = float(motion.inputs["follows"])
    return motion.moved({"h": np.linspace(stroke_of(motion, -range_), stroke_of(motion, range_), count)})


def at_horizon(motion: Motion) -> Motion:
    """Return the same design at the horizon, one pose."""
    require_header(motion)
    return motion.moved({"h": np.array([stroke_of(motion, 0.0)])})


def write_reaction(written: Formulas) -> None:
    """Write the arm H (34), the fluid dV (36), the reaction F_R (38), and while the header goes up and down with its seals (39).

    Where other loads than the machine's own weights act, nothing: the paper's equations do not have them.
    """
    lift, thrust = written.plan.members["lift"], written.thrust("lift")
    frictions = [name for name, each in written.plan.of_kind(ForceElement).items() if isinstance(each, (PinFriction, GuideFriction))]
    if thrust is None or set(written.plan.of_kind(ForceElement)) != {"feeder", "header", "lift", LINE, SHOE, *frictions}:
        return
    assert isinstance(lift, Cylinder)
    area, _ = lift.sides_written(written, thrust)
    (OBx, OBy), (ABx, ABy) = written.between("O", "B"), written.between("A", "B")
    arm = written.line("H", (OBx * ABy - OBy * ABx) / written.distance("A", "B"), "m")
    written.line("dV", (written.inputs["h"] - written.value(ref("h_horizon"))) * area, "l")
    arms = [written.between("O", point)[0] for point in ("G1", "G2")]
    moment = written.line("M_O", written.weight("feeder") * arms[0] + written.weight("header") * arms[1], "Nm")
    out, seals = written.between("O", "R")[0], written.inputs["seals"] * area
    written.line("F_R", (moment - arm * thrust) / out, "kgf")
    written.line("F_R_up", (moment - arm * (thrust - seals)) / out, "kgf")
    written.line("F_R_down", (moment - arm * (thrust + seals)) / out, "kgf")
    written.line("P_req", moment / (arm * area), "kgf/cm2")


def dry_frictions(motion: Motion) -> list[str]:
    """Return the names of the loads that are dry friction of pins and guides."""
    return [name for name, each in motion.plan.of_kind(ForceElement).items() if each.frictions(motion)]


@record
class HeaderState:
    """Values at a motion's poses: arm, pressures, reactions; every array of the motion's shape, cached."""

    motion: Motion

    @property
    def circuit(self) -> FloatCircuit:
        """The closed line of the machine."""
        return self.motion.plan.of_kind(FloatCircuit)["floating"]

    @property
    def cylinder(self) -> Cylinder:
        """The machine's cylinders."""
        found = self.circuit.ram(self.motion)
        assert isinstance(found, Cylinder)
        return found

    @cached_property
    def vessels(self) -> list[tuple[float, float]]:
        """The charges [Pa gauge] and volumes [m3] of the accumulators that are there."""
        each_of = self.circuit.accumulators(self.motion).accumulators
        found = [(float(np.max(each.charge)), float(np.max(each.volume))) for each in each_of]
        return [(charge, volume) for charge, volume in found if volume > 0.0]

    @cached_property
    def height(self) -> FloatArray:
        """Height of the shoe, R_y [m]."""
        return self.motion.value(Coordinate("R", "y"))

    @cached_property
    def arm(self) -> FloatArray:
        """Arm of the cylinder's force about O, H = (OB x AB / |AB|)_z [m]. (34)"""
        OB, AB = self.motion["B"] - self.motion["O"], self.motion["B"] - self.motion["A"]
        return np.asarray((OB[0] * AB[1] - OB[1] * AB[0]) / np.hypot(AB[0], AB[1]))

    @cached_property
    def pressure(self) -> FloatArray:
        """Pressure in the block [Pa gauge]. (36), (17)-(33)"""
        return np.asarray(self.circuit.pressure(self.motion))

    @cached_property
    def required(self) -> FloatArray:
        """Pressure at which the shoe carries nothing, without friction [Pa gauge]."""
        return self.required_while("frictionless")

    def required_while(self, direction: str) -> FloatArray:
        """Return the block's pressure [Pa gauge] at which the shoe carries nothing, in a direction of motion, friction included."""
        size = self.cylinder.sized(self.motion)
        seals = SENSES[direction] * size.sense * self.motion.inputs["seals"]
        return np.asarray(size.pressure_for(self.thrust_without_line(direction)) + seals)

    def thrust_without_line(self, direction: str = "frictionless", pressed: float = 0.0) -> FloatArray:
        """Return the cylinders' thrust [N] that all loads but the line's ask for, the shoes `pressed` with a force [N]."""
        loads: list[ForceElement | str] = [*own_loads(self.motion, LINE, SHOE), Support("R", (0, 1), force=pressed)]
        return driving_force(self.motion, loads, direction=direction) / self.motion.ratio(AB, wrt="h")

    def reaction(self, direction: str, bearing: float | None = None) -> FloatArray:
        """Return the shoes' reaction [N], all shoes: "extending" (up), "retracting" (down) or "frictionless". (38)-(41)

        All loads that the machine declares count; `bearing` is a friction coefficient at O instead of the machine's own.
        """
        if bearing is None:
            return reaction(self.motion, None, SHOE, direction=direction)
        pin = PinFriction("O", self.motion.inputs["pin_O.radius"], bearing)
        return reaction(self.motion, [*own_loads(self.motion, BEARING), pin], SHOE, direction=direction)

    def hysteresis_without(self, *names: str) -> FloatArray:
        """Return reaction up less reaction down [N] of all loads but those named."""
        loads = own_loads(self.motion, *names)
        up, down = (reaction(self.motion, loads, SHOE, direction=way) for way in ("extending", "retracting"))
        return np.asarray(up - down)

    @cached_property
    def of_bearings(self) -> tuple[FloatArray, FloatArray]:
        """The hysteresis [N] with a plain bearing at O instead of the machine's own, and with a rolling one."""
        plain, rolling = (self.reaction("extending", each) - self.reaction("retracting", each) for each in (PLAIN, 0.0))
        return plain, rolling

    @cached_property
    def up(self) -> FloatArray:
        """Reaction while the header rises [N]."""
        return self.reaction("extending")

    @cached_property
    def down(self) -> FloatArray:
        """Reaction while the header sinks [N]."""
        return self.reaction("retracting")

    @cached_property
    def free(self) -> FloatArray:
        """Reaction without friction [N]."""
        return self.reaction("frictionless")

    @property
    def hysteresis(self) -> FloatArray:
        """Reaction up less reaction down [N]."""
        return self.up - self.down

    @cached_property
    def of_seals(self) -> FloatArray:
        """The share of the hysteresis that the cylinders' seals make alone, without friction in any pin [N]."""
        return self.hysteresis_without(*dry_frictions(self.motion))

    @cached_property
    def of_pin(self) -> FloatArray:
        """The share of the pin at O in the hysteresis [N]."""
        return self.hysteresis - (self.hysteresis_without(BEARING) if self.others else self.of_seals)

    @cached_property
    def of_others(self) -> FloatArray:
        """The share of all other friction, of pins that were added, in the hysteresis [N]."""
        return np.asarray(self.hysteresis - self.of_seals - self.of_pin)

    @cached_property
    def others(self) -> list[str]:
        """The names of the friction that was added, beside that of the pin at O."""
        return [name for name in dry_frictions(self.motion) if name != BEARING]


def reaction_columns(motion: Motion) -> list[Column]:
    """Return the table of a motion in the paper's units."""
    balance, shoes = HeaderState(motion), motion.inputs["shoes"]
    OBx, OBy, ABx, ABy = (Coordinate("B", axis) - Coordinate(name, axis) for name in "OA" for axis in "xy")
    arm = (OBx * ABy - OBy * ABx) / AB  # H (34)
    others = Acting(loads=own_loads(motion, SHOE), direction="frictionless")
    free = drive_force("h", acting=others) / ratio(Coordinate("R", "y"))  # the other loads' need over the shoe's way
    return [
        Column("h", motion.strokes["h"], "mm", 1, "h"),
        Column("R_y", balance.height, "mm", 1, Coordinate("R", "y")),
        Column("H", balance.arm, "mm", 2, arm),
        Column("P", balance.pressure, "kgf/cm2", 2, pressure("lift")),
        Column("P_req", balance.required, "kgf/cm2", 2),
        Column(noted("F_R up"), balance.up, "kgf", 1),
        Column(noted("F_R down"), balance.down, "kgf", 1),
        Column(noted("F_R free"), balance.free, "kgf", 1, free),
        Column(noted("per shoe up"), balance.up / shoes, "kgf", 1),
        Column(noted("per shoe down"), balance.down / shoes, "kgf", 1),
        Column(noted("hysteresis"), balance.hysteresis, "kgf", 1),
        Column(noted("of seals"), balance.of_seals, "kgf", 1),
        Column(noted("of pin O"), balance.of_pin, "kgf", 1),
        *([Column(noted("of other pins"), balance.of_others, "kgf", 1)] if balance.others else []),
    ]


def relief(motion: Motion) -> Answer:
    """Return the greatest pressure [Pa gauge] of lifting by the pump from the horizon to the end of the stroke, one design.

    Parameters
    ----------
    motion : Motion
        The poses.

    Returns
    -------
    Answer
        The pressure, and where it is.
    """
    lifted = motion.moved({"h": np.array([stroke_of(motion, 0.0), motion.plan.strokes["h"].end])})
    return answers_over(lifted, [most(MotionFunction(lifting_pressure))])[0]


def lifting_pressure(motion: Motion) -> FloatArray:
    """Return the pressure in the block [Pa gauge] while the pump lifts the header."""
    return HeaderState(motion).required_while("extending")


def kgf_cm2_text(pressure: float, digits: int = 2) -> str:
    """Return a pressure [Pa] in kgf/cm2."""
    return show(float(pressure), "kgf/cm2", f".{digits}f")
