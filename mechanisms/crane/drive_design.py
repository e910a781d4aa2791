"""The design of a crane's drives: every cylinder of a series judged, the pins of each found by `optimise`.

Source: Syunyov, Seliverstov, Gerasimov, Sokolov, "Lesosechnye mashiny v fokuse bioenergetiki", (2.31) to (2.37), (2.60) to (2.66).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from math import pi
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np

from linkage import DefinitionError, Mechanism, StudyError, at, deg, integral, kN, least, mm, most, optimise, ref, x, y
from linkage.errors import cited, ensure, one_word
from linkage.frozen import immutable, record
from linkage.motion.measures import Measure
from linkage.numeric.quadrature import quadrature
from linkage.program import FloatArray
from linkage.quantities import is_number
from linkage.study import InfeasibleError, Optimum
from linkage.units import require_number

from .drive_report import FOLDING, LIFTING, OPENING
from .drives import AngledBellCrankArmDrive, ArmDrive, BoomDrive, DirectArmDrive, DirectArmDriveAbove, DrivenArm
from .duty import DriveCylinders, DriveDuty, clipped

LETTERS = (LIFTING, "M_g"), (FOLDING, "|M_g1|"), (OPENING, "M_g2")
"""The source's letters of the moments given."""


@immutable
class JudgedSize:
    """One cylinder of a series: bore and rod [m], the best drive with it, or in words why there is none.

    `could` is the work that its longest stroke takes in [J], `asked` the work that the load asks of it.
    """

    bore: float
    rod: float
    could: float
    asked: float
    optimum: Optimum | None
    reason: str = ""

    @property
    def value(self) -> float:
        """The objective of the search, infinite where there is no drive."""
        return np.inf if self.optimum is None else self.optimum.value

    @property
    def is_too_small(self) -> bool:
        """Whether its longest stroke takes in less than the load asks, so that no pins help."""
        return self.could < self.asked


@immutable
class DriveDesign:
    """All cylinders of a series judged for one drive, in the order of the series; `best` has the least objective.

    Attributes
    ----------
    what : str
        The drive.
    objective : str
        What is made least.
    sizes : tuple of JudgedSize
        The cylinders, each with the drive found for it or why there is none.
    """

    what: str
    objective: str
    sizes: tuple[JudgedSize, ...]

    @property
    def best(self) -> JudgedSize:
        """The size that does best; DefinitionError, with all reasons, where none does."""
        found = min(self.sizes, key=lambda each: each.value)
        if found.optimum is None:
            raise DefinitionError(f"No cylinder of the series serves the {self.what} drive. {' '.join(self.sentences)}")
        return found

    @property
    def machine(self) -> Mechanism:
        """The best drive."""
        optimum = self.best.optimum
        assert optimum is not None
        return optimum.machine

    @property
    def sentences(self) -> list[str]:
        """The result of every size, in words: those that are too small in one sentence, by the energy that they swallow."""
        small, found = [each for each in self.sizes if each.is_too_small], []
        if small:
            ends = small if len(small) == 1 else (small[0], small[-1])
            both = [each.bore / mm for each in ends], [each.could for each in ends]
            bores, could = (" to ".join(f"{each:.0f}" for each in values) for values in both)
            many, longest = ("they would", "their longest strokes take") if len(small) > 1 else ("it would", "its longest stroke takes")
            found.append(f"{bores} mm cannot: {many} have to swallow the {small[0].asked:.0f} J the load asks; {longest} {could} J.")
        for size in self.sizes:
            name = f"{size.bore / mm:.0f}/{size.rod / mm:.0f} mm"
            if size.optimum is not None:
                stroke = float(size.optimum.machine["S"])
                found.append(f"{name}: {self.objective} {OBJECTIVES[self.objective](size.value)}, stroke {stroke / mm:.1f} mm.")
            elif not size.is_too_small:
                found.append(f"{name} cannot: {size.reason}")
        return found

    def __str__(self) -> str:
        best = f"The best {self.what} drive has {self.best.bore / mm:.0f}/{self.best.rod / mm:.0f} mm."
        return "\n".join([*self.sentences, best])


OBJECTIVES: Mapping[str, Callable[[float], str]] = MappingProxyType(
    {
        "area": lambda value: f"{value / kN:.2f} kNm rad",
        "ratio": lambda value: f"{value:.4f}",
        "difference": lambda value: f"{value / kN:.2f} kNm",
        "weight": lambda value: f"{7800.0 * value:.2f} kg",
    }
)
"""What a drive may be chosen by, and how its value is said."""


def work_of(moment: Callable[[FloatArray], FloatArray], start: float, end: float) -> float:
    """Return the work of a moment over an angle [J]."""
    return float((end - start) * quadrature(lambda share: moment(start + (end - start) * share)).value)


def judged(
    cylinders: DriveCylinders, could: Callable[[float, float], float], asked: float, task: Callable[[float, float], Mapping[str, Any]]
) -> tuple[JudgedSize, ...]:
    """Return every size of a series judged: by the energy bound first, then by a search, whose arguments `task` gives.

    The reason why none is found is what the drive that misses least falls short of, moments by the source's letters.
    """
    found = []
    for bore, rod in cylinders.sizes:
        optimum, reason, work = None, "", could(bore, rod)
        try:
            optimum = None if work < asked else optimise(**task(bore, rod))
        except StudyError as error:
            reason = str(error)
            if isinstance(error, InfeasibleError):
                reason = f"no pins found keep everything, the nearest miss {'; '.join(each.sentence for each in error.relaxations)}."
            for movement, letters in LETTERS:
                reason = reason.replace(str(movement.given), letters)
        assert optimum is None or isinstance(optimum, Optimum)
        found.append(JudgedSize(bore, rod, work, asked, optimum, reason))
    return tuple(found)


# -- the boom ----------------------------------------------------------------------------------------------

CLEARANCES: Mapping[str, Callable[[float, float], float]] = MappingProxyType(
    {"b/2 + D": lambda section, bore: 0.5 * section + bore, "(b + D)/2": lambda section, bore: 0.5 * (section + bore)}
)
"""The readings of (2.35): how far a pin lies from the axis of a section of the height b, with a bore D."""


def design_boom_drive(
    duty: DriveDuty | None = None,
    cylinders: DriveCylinders | None = None,
    *,
    objective: str = "area",
    clearance: str = "b/2 + D",
    lowest_pin: float = 0.5,
    r_3_min: float = 0.30,
    starts: int | None = None,
    seed: int = 0,
) -> DriveDesign:
    """Return the boom's drive, every cylinder of the series judged: the stroke S and the pins r_2, r_3 that `optimise` finds for each.

    Kept are both ends of the cylinder (2.31), M_g >= M_l (2.34), S up to the longest stroke, lowest_pin l <= r_2 <= h_0 (2.37), r_3_min <=
    r_3 <= l_c. Sizes that cannot do it are reported in words, not raised.

    Parameters
    ----------
    duty : DriveDuty, optional
        The duty, the source's by default.
    cylinders : DriveCylinders, optional
        The series.
    objective : {"area", "ratio", "difference"}, optional
        "area", what is given over what is asked integrated over the angle (2.33); "ratio", its greatest M_g / M_l (2.32); or "difference",
        (2.32) read as the greatest M_g - M_l.
    clearance : {"b/2 + D", "(b + D)/2"}, optional
        How (2.35) is read.
    lowest_pin : float, optional
        The least r_2 in parts of the closed length l.
    r_3_min : float, optional
        The least r_3 [m].
    starts, seed : int, optional
        As of `optimise`.

    Returns
    -------
    DriveDesign
        The cylinders judged.
    """
    duty, cylinders = duty or DriveDuty(), cylinders or DriveCylinders()
    one_word("objective", objective, ("area", "ratio", "difference"))
    one_word("clearance", clearance, tuple(CLEARANCES))
    expected = f"a length below the boom's {duty.l_c:.4g} m is expected, such as 300 * mm"
    require_number("r_3_min", r_3_min, expected, above=0.0, below=duty.l_c, kind="length")
    require_number("lowest_pin", lowest_pin, "a share of the closed length is expected, 0 to 1; the source has 0.5", least=0.0, most=1.0)
    pin, share = CLEARANCES[clearance], LIFTING.given / LIFTING.asked
    least_of = {"area": integral(LIFTING.surplus), "ratio": most(share), "difference": most(LIFTING.surplus)}

    def drive(bore: float, rod: float) -> BoomDrive:
        return BoomDrive(
            **cylinders.dimensions(bore, rod), **duty.asked_of(BoomDrive), r_1=pin(duty.b_0, bore), r_4=pin(duty.b_c, bore),
            S=0.8 * cylinders.longest * bore, r_2=0.85 * duty.h_0, r_3=max(0.14 * duty.l_c, r_3_min),
        )  # fmt: skip

    kept = [
        at("length", phi=duty.phi_k) == at("l"), at("length", phi=duty.phi_0) == at(ref("l") + ref("S")),
        least(share) >= 1.0, at("r_2") >= lowest_pin * at("l"),
    ]  # fmt: skip

    def task(bore: float, rod: float) -> Mapping[str, Any]:
        longest = cylinders.longest * bore
        vary = {"S": (0.1 * longest, longest), "r_2": (0.05 * duty.h_0, duty.h_0), "r_3": (r_3_min, duty.l_c)}
        return dict(
            machine=drive(bore, rod), minimise=least_of[objective], vary=vary, subject_to=kept, over={"phi": (duty.phi_0, duty.phi_k)},
            starts=starts, seed=seed,
        )  # fmt: skip

    bound = drive(*cylinders.sizes[-1])
    asked = work_of(lambda phi: bound.at(phi=phi)["M_l"], duty.phi_0, duty.phi_k)
    return DriveDesign("boom", objective, judged(cylinders, lambda bore, rod: cylinders.swallowed(bore), asked, task))


# -- the arm -----------------------------------------------------------------------------------------------

ARM_BOUNDS: Mapping[str, tuple[float, float]] = MappingProxyType(
    {"r_1": (0.15, 0.80), "r_2": (0.15, 1.20), "r_3": (0.12, 0.60), "r_4": (0.10, 0.80), "r_5": (0.50, 4.00), "alpha_20": (-150 * deg, 0.0)}
)
"""The source's bounds of the lengths [m]; of the lug's direction on the folded arm [rad]."""
DIRECT_BOUNDS: Mapping[str, tuple[float, float]] = MappingProxyType(
    {"r_1": (0.15, 0.60), "r_2": (0.50, 4.00), "r_3": (0.12, 0.60), "r_4": (0.15, 0.60)}
)
"""Bounds of a drive without a four-bar [m], after those above: its pins stand beside boom and arm."""


SCHEMES: Mapping[str, tuple[type[DrivenArm], Mapping[str, tuple[float, float]]]] = MappingProxyType(
    {
        "a": (ArmDrive, ARM_BOUNDS),
        "b": (AngledBellCrankArmDrive, {**ARM_BOUNDS, "r_8": (0.15, 0.80)}),
        "c": (DirectArmDrive, DIRECT_BOUNDS),
        "d": (DirectArmDriveAbove, {**DIRECT_BOUNDS, "r_3": (-0.60, 0.60)}),
    }
)
"""The arm drives of fig. 2.13, by letter, with the bounds of their lengths [m] and angles [rad]."""

TRAVELS = ("free", "travels", "angles")
FINE = 10.0 * kN
"""N m, added to both sides of what would be compared with zero: conditions are met to a small part of their size."""
STEP = 1e-6
"""rad: over which a condition sets in."""
LEAST_TRANSMISSION = 25 * deg


@record
class ArmRules:
    """The conditions of an arm drive beside its moments, and the reading of the source's lost signs.

    A drive without a four-bar keeps (2.62), (2.64) and the boom's length alone: (2.61) is what a four-bar is for.

    Parameters
    ----------
    r_6 : float, optional
        The height of the boom drive's pin C above the boom's axis [m].
    delta : float, optional
        The bend [rad].
    crank : float, optional
        The bell crank's angle at its pivot [rad].
    eyes : float, optional
        The eyes that (2.60) counts.
    excess : float, optional
        k_r of (2.61): M_g2 is over M_l2 by no more than (k_r - 1) K_A.
    excess_from : {"phi_0", "psi_0"}, optional
        From where on the excess counts.
    above : {"r_6"}, float or None, optional
        What the lever's pins stay above the boom's axis at both ends (2.63): "r_6", a height [m], or nothing.
    angles : {"free", "travels", "angles"}, optional
        The reading of (2.65): "free" does not impose it, "travels" asks lever and arm for 90 and 100 deg of travel, "angles" holds alpha_1
        under 90 and alpha_2 under 100 deg.
    transmission : float, optional
        The least angle between coupler and lug [rad], 0 for none.
    """

    r_6: float = 150 * mm
    delta: float = 0.0
    crank: float = 23.07391806563097 * deg
    eyes: float = 1.0
    excess: float = 1.6
    excess_from: str = "phi_0"
    above: str | float | None = "r_6"
    angles: str = "free"
    transmission: float = LEAST_TRANSMISSION

    def __post_init__(self) -> None:
        one_word("excess_from", self.excess_from, ("phi_0", "psi_0"))
        one_word("angles", self.angles, TRAVELS)
        require_number("excess", self.excess, "k_r of (2.61) is a number above 1; the source's example has 1.6", above=1.0)
        if not (self.above is None or self.above == "r_6" or is_number(self.above)):
            raise DefinitionError(f"above={cited(self.above)}: 'r_6', a height in m or None is expected.")
        says = "the bell crank's angle at its pivot is expected, between 0 and 180 * deg"
        require_number("crank", self.crank, says, above=0.0, below=pi, kind="angle")
        says = "an angle below 90 * deg is expected, 0 for none"
        require_number("transmission", self.transmission, says, least=0.0, below=0.5 * pi, kind="angle")

    def conditions(self, duty: DriveDuty, scheme: str = "a") -> list[Any]:
        """Return the conditions (2.61) to (2.65) of a duty.

        Parameters
        ----------
        duty : DriveDuty
            The duty.
        scheme : str, optional
            The scheme of fig. 2.13, whose drives keep them.

        Returns
        -------
        list of Condition
            The conditions.
        """
        psi_0, psi_k, (machine, _) = duty.psi_0, duty.psi_k, SCHEMES[scheme]
        closed, out = (psi_0, psi_k) if machine.opens_by_piston else (psi_k, psi_0)
        found = [
            at("length", psi=closed) == at("l"),
            at("length", psi=out) == at(ref("l") + ref("S")),
            least(OPENING.surplus + FINE) >= FINE,
            least(FOLDING.given + ref("M_l1") + FINE) >= FINE,
        ]
        if issubclass(machine, DirectArmDrive):
            return [*found, at("r_2") <= duty.l_c]
        counts = clipped(1.0 + (ref("psi") - duty.phi_0) / STEP, 0.0, 1.0) if self.excess_from == "phi_0" else 1.0
        found += [
            most(OPENING.surplus * counts) <= (self.excess - 1.0) * duty.K_A,
            at(x("L") + (ref("r_2") - ref("r_3")) * np.cos(ref("alpha_20")), psi=psi_0) >= at("r_4"),
            at("r_2") <= at(ref("r_1") + ref("r_3") - ref("r_4")),
            at(ref("r_4") + ref("r_5")) <= duty.l_c,
            at("alpha_1", psi=psi_0) >= self.delta,
        ]
        if self.above is not None:
            height = self.r_6 if self.above == "r_6" else float(self.above)
            found += [at(y(pin), psi=psi) >= height for pin in ("LZ" if scheme == "b" else "L") for psi in (psi_0, psi_k)]
        if self.transmission:
            found += [least("mu") >= self.transmission, most("mu") <= pi - self.transmission]
        for name, most_angle in (("alpha_1", 90 * deg), ("alpha_2", 100 * deg)) if self.angles != "free" else ():
            end = at(name, psi=psi_k)
            found.append(end <= most_angle if self.angles == "angles" else end - at(name, psi=psi_0) >= most_angle)
        return found


def design_arm_drive(
    duty: DriveDuty | None = None,
    cylinders: DriveCylinders | None = None,
    *,
    scheme: str = "a",
    rules: ArmRules | None = None,
    objective: str = "weight",
    bounds: Mapping[str, tuple[float, float]] | None = None,
    most_area: float | None = None,
    starts: int | None = None,
    seed: int = 0,
) -> DriveDesign:
    """Return the arm's drive, every cylinder of the series judged: lengths and stroke by `optimise`.

    Sizes that cannot do it are reported in words, not raised.

    Parameters
    ----------
    duty : DriveDuty, optional
        The duty, the source's by default.
    cylinders : DriveCylinders, optional
        The series.
    scheme : {"a", "b", "c", "d"}, optional
        That of fig. 2.13: "a" over a lever and a coupler, "b" over a bell crank, "c" straight from under the boom, "d" from above.
    rules : ArmRules, optional
        The conditions (2.61) to (2.65).
    objective : {"weight", "area"}, optional
        "weight", the steel of (2.60), or "area", M_g2 - M_l2 integrated over the angle.
    bounds : mapping of str to tuple of float, optional
        Those of the lengths [m] and of alpha_20 [rad], by default the scheme's.
    most_area : float, optional
        The bound of the area [N m rad] while the weight is least.
    starts, seed : int, optional
        As of `optimise`.

    Returns
    -------
    DriveDesign
        The cylinders judged.
    """
    duty, cylinders, rules = duty or DriveDuty(), cylinders or DriveCylinders(), rules or ArmRules()
    one_word("objective", objective, ("weight", "area"))
    one_word("scheme", scheme, tuple(SCHEMES))
    # Bounds, by default a scheme's; DefinitionError for those that leave something out or nothing in.
    machine, own = SCHEMES[scheme]
    bounds = own if bounds is None else bounds
    for name in own:
        ends = bounds.get(name)
        if ends is None or len(ends) != 2 or not all(map(is_number, ends)) or not ends[0] < ends[1]:
            raise DefinitionError(f"bounds[{name!r}] = {cited(ends)}: (low, high) is expected, low below high, in SI.")
    lengths = ("r_2",) if issubclass(machine, DirectArmDrive) else ("r_4", "r_5")
    least_length = sum(bounds[name][0] for name in lengths)
    what = f"bounds: {' + '.join(lengths)} is {least_length:.4g} m at the least"
    ensure(least_length <= duty.l_c, f"{what}, more than the boom, {duty.l_c:.4g} m; lower them.")
    if most_area is not None:
        require_number("most_area", most_area, "a number above zero is expected, in N m rad", above=0.0, kind=None)
    from_on, opens = max(duty.phi_0, duty.psi_0), SCHEMES[scheme][0].opens_by_piston
    bound = arm_drive(duty, cylinders, rules, *cylinders.sizes[-1], scheme)
    asked = work_of(lambda psi: bound.at(psi=psi)["M_l2"], from_on, duty.psi_k)
    # what is given over what is asked, from phi_0 on: by virtual work the integral of M_g2 is the force times the way of the cylinder
    area: Measure = at("opens") * (at("length", psi=duty.psi_k) - at("length", psi=from_on)) - asked
    conditions = rules.conditions(duty, scheme) + ([] if most_area is None else [area <= most_area])

    def swallowed(bore: float, rod: float) -> float:
        return cylinders.swallowed(bore) if opens else cylinders.swallowed(bore, rod)

    def task(bore: float, rod: float) -> Mapping[str, Any]:
        vary = {**bounds, "S": (0.2 * cylinders.longest * bore, cylinders.longest * bore)}
        return dict(
            machine=arm_drive(duty, cylinders, rules, bore, rod, scheme), minimise="steel" if objective == "weight" else area, vary=vary,
            subject_to=conditions, over={"psi": (duty.psi_0, duty.psi_k)}, starts=starts, seed=seed,
        )  # fmt: skip

    return DriveDesign("arm", objective, judged(cylinders, swallowed, asked, task))


def arm_drive(duty: DriveDuty, cylinders: DriveCylinders, rules: ArmRules, bore: float, rod: float, scheme: str = "a") -> DrivenArm:
    """Return an arm drive for a duty, its lengths those of the shipped one: the start of a search."""
    machine, _ = SCHEMES[scheme]
    own = () if issubclass(machine, DirectArmDrive) else ("r_6", "delta", "crank") if scheme == "b" else ("r_6", "delta")
    given = {name: getattr(rules, name) for name in ("eyes", *own)}
    S = min(0.66, 0.9 * cylinders.longest * 0.1) * 10.0 * bore
    return machine(**cylinders.dimensions(bore, rod), **duty.asked_of(machine), **given, S=S)


class Compromise(NamedTuple):
    """An arm drive between its two criteria: mass [kg], area [N m rad]."""

    drive: Mechanism
    mass: float
    area: float


def arm_drive_front(
    bore: float, rod: float, duty: DriveDuty | None = None, cylinders: DriveCylinders | None = None, *, count: int = 5, **options: Any
) -> list[Compromise]:
    """Return the Pareto front of one cylinder, from the least mass to the least area, the area bounded step by step.

    Parameters
    ----------
    bore, rod : float
        The cylinder [m].
    duty : DriveDuty, optional
        The duty, the source's by default.
    cylinders : DriveCylinders, optional
        Pressure and lengths of the cylinder.
    count : int, optional
        How many drives, 5 by default.
    **options : object
        Those of `design_arm_drive`.

    Returns
    -------
    list of Compromise
        The drives.

    Raises
    ------
    DefinitionError
        The cylinder does not serve at all.
    """
    ensure(count >= 2, f"count={count}: a front has two ends at least.")
    one = replace(cylinders or DriveCylinders(), sizes=((bore, rod),))

    def compromise(objective: str, most_area: float | None) -> Compromise:
        drive = design_arm_drive(duty, one, objective=objective, most_area=most_area, **options).machine

        def surplus(psi: Any) -> Any:
            motion = drive.at(psi=psi)
            return motion["opens"] * motion.ratio("length") - motion["M_l2"]

        area = work_of(surplus, max(float(drive["phi_0"]), float(drive["psi_0"])), float(drive["psi_k"]))
        return Compromise(drive, float(drive.at(psi=drive["psi_0"])["mass"]), area)

    light, small = compromise("weight", None), compromise("area", None)
    between = np.linspace(light.area, small.area, count)[1:-1]
    return [light, *(compromise("weight", float(area)) for area in between), small]
