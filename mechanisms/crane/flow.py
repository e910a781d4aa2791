"""From a duty to a crane: each stage takes the result of the one before, or the user's in its place.

`design_crane` is the whole way; its stages are `design_skeleton`, `duty_of` what it asks of its drives, `design_boom_drive`,
`design_arm_drive`, and `with_drives`, the whole crane.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

from linkage import DefinitionError, deg, least, optimise, ref
from linkage.frozen import immutable
from linkage.study import Optimum

from .arm_schemes import BellCrankCrane, DirectCrane, DirectCraneAbove
from .drive_design import DriveDesign, design_arm_drive, design_boom_drive
from .drives import ArmDrive, BellCrankArmDrive, BoomDrive, DirectArmDrive, DirectArmDriveAbove, DrivenArm
from .duty import DriveCylinders, Duty, duty_of
from .machine import Crane
from .skeleton import BackBrokenSkeleton, CraneSkeleton

SKELETON: Mapping[str, tuple[float, float]] = MappingProxyType(
    {"l_c": (1.7, 12.0), "l_p": (1.0, 8.0), "l_t": (0.5, 6.0), "h_0": (0.8, 3.5), "phi_0": (15 * deg, 30 * deg)}
)
"""What a skeleton's search may change, and how far [m, rad]; the angle as the source bounds it."""

BACK_BROKEN: Mapping[str, tuple[float, float]] = MappingProxyType(
    {"phi_k": (90 * deg, 180 * deg), "psi_k": (180 * deg, 270 * deg), "Delta": (0.0, 3.0)}
)
"""And of a back-broken one, too; beyond 270 deg the arm would lie on the boom again."""


def design_skeleton(
    duty: Duty | None = None,
    *,
    reading: str = ">=",
    cab: float | None = None,
    vary: Mapping[str, tuple[float, float]] | None = None,
    starts: int | None = None,
    seed: int = 0,
    progress: Any = False,
) -> Optimum:
    """Return the skeleton of least W_m (2.4) for a duty: `design_skeleton(Duty(L=8.5)).machine`.

    Parameters
    ----------
    duty : Duty, optional
        The duty, the source's by default.
    reading : {">=", "<="}, optional
        How (2.13) is read: ">=", the folded tip clears the guard, or "<=", it comes as near.
    cab : float, optional
        The distance of the column's axis from the cab [m]: with it the crane is back-broken in transport, (2.17), (2.18).
    vary : mapping of str to tuple of float, optional
        Other bounds of variables [SI].
    starts, seed : int, optional
        As of `optimise`.
    progress : bool or callable, optional
        As of `optimise`.

    Returns
    -------
    Optimum
        The skeleton.

    Raises
    ------
    InfeasibleError
        No skeleton keeps all conditions; the conflict and the least relaxation are named.
    """
    asked = Duty() if duty is None else duty
    made = CraneSkeleton if cab is None else BackBrokenSkeleton
    machine = made(**asked.dimensions(), **({} if cab is None else {"A_k": cab}))
    ranges = {**SKELETON, **({} if cab is None else BACK_BROKEN), **(vary or {})}
    rules = made.conditions(reading)
    found = optimise(
        machine,
        minimise=least(ref("W_m")),
        vary={name: ends for name, ends in ranges.items()},
        subject_to=[
            *(least(ref(name)) == 0.0 for name in made.errors),
            *(least(ref(name)) >= 0.0 for name in (*rules, "boom_turns", "b_c")),
        ],
        starts=starts,
        seed=seed,
        progress=progress,
    )
    assert isinstance(found, Optimum)  # of one objective
    return found


@immutable
class CraneDesign:
    """A crane designed from its duty: the result of each stage, and the whole crane.

    Attributes
    ----------
    skeleton : Optimum, optional
        The skeleton, None where the user gave it.
    boom, arm : DriveDesign, optional
        The drives, None where the user gave them.
    crane : Crane
        The crane.
    """

    skeleton: Optimum | None
    boom: DriveDesign | None
    arm: DriveDesign | None
    crane: Crane


def design_crane(
    duty: Duty | None = None,
    *,
    skeleton: CraneSkeleton | None = None,
    boom: BoomDrive | None = None,
    arm: DrivenArm | None = None,
    scheme: str = "a",
    cylinders: DriveCylinders | None = None,
    reading: str = ">=",
    cab: float | None = None,
    progress: Any = False,
) -> CraneDesign:
    """Return a crane for a duty: skeleton, boom drive, arm drive, each from the stage before.

    Parameters
    ----------
    duty : Duty, optional
        The duty, the source's by default.
    skeleton : CraneSkeleton, optional
        Replaces the first stage's result.
    boom : BoomDrive, optional
        Replaces the second stage's result.
    arm : DrivenArm, optional
        Replaces the third stage's result.
    scheme : {"a", "b", "c", "d"}, optional
        That of the arm's drive, fig. 2.13; c and d want an arm that folds little, such as Duty(psi_0=60 * deg).
    cylinders : DriveCylinders, optional
        Those that the drives are chosen from.
    reading, cab : optional
        As of `design_skeleton`.
    progress : bool or callable, optional
        As of `optimise`.

    Returns
    -------
    CraneDesign
        The crane, and the result of each stage.

    Raises
    ------
    DefinitionError
        No cylinder serves a drive; all reasons are named.
    """
    found = None if skeleton is not None else design_skeleton(duty, reading=reading, cab=cab, progress=progress)
    bare = skeleton if found is None else found.machine
    assert isinstance(bare, CraneSkeleton)
    asked = duty_of(bare)
    lifting = None if boom is not None else design_boom_drive(asked, cylinders)
    folding = None if arm is not None else design_arm_drive(asked, cylinders, scheme=scheme)
    chosen_boom = boom if lifting is None else lifting.machine
    chosen_arm = arm if folding is None else folding.machine
    assert isinstance(chosen_boom, BoomDrive) and isinstance(chosen_arm, DrivenArm)
    return CraneDesign(found, lifting, folding, with_drives(bare, chosen_boom, chosen_arm))


CRANES: Mapping[type[DrivenArm], type[Crane]] = MappingProxyType(
    {BellCrankArmDrive: BellCrankCrane, DirectArmDriveAbove: DirectCraneAbove, DirectArmDrive: DirectCrane, ArmDrive: Crane}
)
"""Of each arm drive the crane that has it; subclasses first."""
CYLINDERS: Mapping[str, str] = MappingProxyType({"boom": "lift", "arm": "fold"})


def with_drives(skeleton: CraneSkeleton, boom: BoomDrive, arm: DrivenArm) -> Crane:
    """Return the whole crane of a skeleton, a boom drive and an arm drive, all of one design.

    The telescope's cylinder is as long as the telescope asks; its bore is that of the shipped crane.

    Parameters
    ----------
    skeleton : CraneSkeleton
        The skeleton.
    boom : BoomDrive
        The boom's drive.
    arm : DrivenArm
        The arm's drive.

    Returns
    -------
    Crane
        The crane.

    Raises
    ------
    DefinitionError
        The arm drive is of another than the four schemes.
    """
    made = next((crane for drive, crane in CRANES.items() if isinstance(arm, drive)), None)
    if made is None:
        what = f"{arm.plan.title} is no arm drive of the four schemes"
        raise DefinitionError(f"{what}; the whole crane takes an ArmDrive or a DirectArmDrive.")
    numbers: dict[str, Any] = {name: skeleton[name] for name in CraneSkeleton.plan.defaults if name in made.plan.defaults}
    drives: dict[str, BoomDrive | DrivenArm] = {"boom": boom, "arm": arm}
    numbers |= {name: number_of(drive, own) for side, drive in drives.items() for name, own in names_of(made, side).items()}
    if isinstance(arm, ArmDrive):
        numbers |= {"lug": 180 * deg + arm["alpha_20"] - arm["psi_0"], "bend": arm["delta"]}
    closed = float(skeleton["l_p"]) - Crane.plan.defaults["root_pin"]
    return made(**numbers, **{"extend.stroke": float(skeleton["l_t"]), "extend.closed": closed})


def names_of(crane: Crane | type[Crane], side: str) -> dict[str, str]:
    """Return the names of a drive's lengths and cylinder in the whole crane, each with its name in the drive on its own."""
    start, cylinder = f"{side}_r", CYLINDERS[side]
    own = {name: f"r_{name.removeprefix(start)}" for name in crane.plan.defaults if name.startswith(start)}
    own |= {f"{cylinder}.{name}": letter for name, letter in (("bore", "D"), ("rod", "d"), ("stroke", "S"), ("closed", "l"))}
    return own | {f"{cylinder}_line.pressure": "p", f"{cylinder}_line.mechanical_efficiency": "n"}


def number_of(drive: BoomDrive | DrivenArm, name: str) -> float:
    """Return a number of a drive, a design variable or a value that follows from some."""
    return float(drive[name]) if name in drive.dimensions else float(drive.working(2)[name][0])


def boom_drive_of(crane: Crane) -> BoomDrive:
    """Return the boom's drive of a whole crane of one design on its own, with the crane's required moments.

    Parameters
    ----------
    crane : Crane
        The crane, one design.

    Returns
    -------
    BoomDrive
        The drive.
    """
    return BoomDrive(**duty_of(crane).asked_of(BoomDrive), **own_numbers(crane, "boom"))


def arm_drive_of(crane: Crane) -> DrivenArm:
    """Return the arm's drive of a whole crane of one design on its own, with the crane's required moments.

    Parameters
    ----------
    crane : Crane
        The crane, one design.

    Returns
    -------
    DrivenArm
        The drive.
    """
    duty = duty_of(crane)
    drive = next(drive for drive, made in CRANES.items() if isinstance(crane, made))
    asked = duty.asked_of(drive)
    if issubclass(drive, ArmDrive):
        asked |= {"alpha_20": float(crane["lug"]) - 180 * deg + duty.psi_0, "delta": float(crane["bend"])}
    return drive(**asked, **own_numbers(crane, "arm"))


def own_numbers(crane: Crane, side: str) -> dict[str, float]:
    """Return a drive's numbers as it calls them on its own; its closed length l as f_0 of (2.36), with f_1 = 0."""
    found = {own: float(crane[name]) for name, own in names_of(crane, side).items()}
    return found | {"f_0": found.pop("l") - found["S"], "f_1": 0.0}
