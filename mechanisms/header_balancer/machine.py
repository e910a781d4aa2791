"""The balanced header: feeder and header swing about O on two cylinders with gas accumulators."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import suppress
from typing import Any

import numpy as np

from hydraulics import Accumulator, AccumulatorBlock, Cylinder, FloatCircuit, isothermal
from hydraulics.inputs import in_pascals, not_negative, positive
from linkage import LEFT, Column, Dyad, Featured, Ground, Link, Mechanism, Motion, OnLink, Outline, PinFriction, Support, Vector, Weight
from linkage.errors import DefinitionError, cited, require
from linkage.language import noted, said
from linkage.loads.element import Formulas
from linkage.quantities import Dimension, Stroke, angle, distance, is_whole, numbers_in, y
from linkage.units import deg, kg, kgf_cm2, litre, mm
from linkage.verdict import Remark, Verdict

from .criteria import HEADERS, SLOW, Way, charge_for, criteria, largest_charge
from .following import HeaderState, over_following, reaction_columns, stroke_at, write_reaction


class HeaderBalancer(Mechanism):
    """Feeder housing and header OBR swing about O; two cylinders AB on a closed accumulator block carry part of their weight.

    R is the shoe, G1 the feeder's and G2 the header's centre of gravity. h is the cylinder's stroke, h_horizon that at
    which the shoe stands on the horizon (R_y = 0), where the line is charged to `charge`. Reactions are totals of all
    shoes. Pressures are gauge; the gas law works on gauge + `atmosphere`; atmosphere=0 is the paper's own way.

    The dimensions are illustrative, the paper prints none; masses, charges and seal friction are the paper's; the rod,
    the pump's and the relief valve's pressure are illustrative too. As it stands it has header 2: `with_header(1)`.
    """

    h = Stroke(0.0, 0.45)  # m
    L_min = Dimension(0.70, unit="mm")  # distance of the cylinder's pins at h = 0
    L_OB = Dimension(0.930054, unit="mm")
    L_OR = Dimension(2.040833, unit="mm")
    BOR = Dimension(5.290081 * deg, unit="deg")

    O = Ground(0.0, 1.05)
    A = Ground(-0.05, 0.30)

    B = Dyad(O, A, OB=L_OB, AB=L_min + h, side=LEFT)  # from O: AOB = Tcos(|OA|, L_OB, L_AB), as the paper has it
    R = OnLink(O, B, OR=L_OR, BOR=BOR)  # the shoe
    G1 = OnLink(O, B, OG1=0.488774, BOG1=5.491118 * deg)  # the feeder's centre of gravity
    G2 = OnLink(O, B, OG2=1.436851, BOG2=18.840343 * deg)  # the header's
    AB = Vector(A, B)
    housing = Link(O, B, R)  # with the header

    h_horizon = stroke_at(0.0, y(O), distance(O, A), angle(O, A), L_OB, L_OR, BOR, L_min)

    m1 = Dimension(1500 * kg, unit="kg")
    m2 = Dimension(1000 * kg, unit="kg")
    charge = Dimension(34 * kgf_cm2, unit="kgf/cm2")  # of the line, at the horizon
    V_I = Dimension(4 * litre, unit="l")  # two accumulators of 2 l; 0: none
    P_I = Dimension(50 * kgf_cm2, unit="kgf/cm2")
    V_II = Dimension(4 * litre, unit="l")
    P_II = Dimension(25 * kgf_cm2, unit="kgf/cm2")
    seals = Dimension(3 * kgf_cm2, unit="kgf/cm2")  # seal friction, as a pressure
    atmosphere = Dimension(101325.0, unit="Pa")
    n = Dimension(1.0)  # 1 slow (isothermal); 1.4 fast, from the settled charge
    follows = Dimension(150 * mm, unit="mm")  # the shoe's travel to either side of the horizon
    shoes = Dimension(2.0)
    pump = Dimension(160 * kgf_cm2, unit="kgf/cm2")
    valve = Dimension(150 * kgf_cm2, unit="kgf/cm2")  # where the relief valve opens

    feeder = Weight(G1, mass=m1)
    header = Weight(G2, mass=m2)
    shoe = Support(R, (0, 1))
    pin_O = PinFriction(O, radius=70 * mm, coefficient=0.0)  # a rolling bearing; a plain one: 0.15
    lift = Cylinder(A, B, bore=63 * mm, rod=40 * mm, count=2, closed=0.70, stroke=0.45)
    floating = FloatCircuit(
        lift,
        AccumulatorBlock([Accumulator(V_I, P_I), Accumulator(V_II, P_II)], isothermal, atmosphere),
        charge_pressure=charge, at=h_horizon, seal_friction=seals, exponent=n,
    )  # fmt: skip

    ground = Outline.line((-3.0, 0.0), (5.0, 0.0))  # what stands around is drawn only; its figures are illustrative
    wheel = Outline.circle(at=(-0.75, 0.75), radius=0.75)  # the combine's front wheel
    table = Outline(
        [(-0.632, -0.403), (0.144, 0.052), (0.626, -0.557), (0.541, -0.608), (0.197, -0.231), (-0.195, -0.257)], on=(R, O)
    )  # the header's section

    def __init__(self, **dimensions: Any) -> None:
        """Set the design [SI]; DefinitionError also for impossible values: no mass, no pressure, a shoe out of the stroke's reach."""
        super().__init__(**dimensions)
        for name in ("L_min", "L_OB", "L_OR", "m1", "charge", "follows", "shoes", "pump", "valve"):
            positive(self[name], name)
        for name in ("m2", "seals", "atmosphere", "V_I", "V_II"):
            not_negative(self[name], name)
        for volume, charge in (("V_I", "P_I"), ("V_II", "P_II")):
            there = np.asarray(self[volume]) > 0.0
            in_pascals(positive(self[charge] if np.all(there) else np.where(there, self[charge], self["pump"]), charge), charge)
        for name in ("charge", "seals", "atmosphere", "pump", "valve"):
            in_pascals(self[name], name)
        if np.any(np.asarray(self["charge"]) > np.asarray(self["pump"])):
            raise DefinitionError(
                f"The charge pressure {np.max(self['charge']) / kgf_cm2:.4g} kgf/cm2 is above the pump's, "
                f"{np.min(self['pump']) / kgf_cm2:.4g} kgf/cm2, which has to bring it; lower the charge or take a stronger pump."
            )

    def columns(self, motion: Motion) -> list[Column]:
        """Return stroke, shoe, arm, pressures and reactions, of all shoes and of one."""
        return reaction_columns(motion)

    def formulas(self, written: Formulas) -> None:
        """Write, after the lines of its elements, (34), (36), (38) and (39), and the pressure at which the shoe carries nothing."""
        super().formulas(written)
        write_reaction(written)

    def featured(self) -> Featured:
        """Return the shoe's reaction, which may not fall below zero, the pressure with the relief valve's, and the path of the shoe R."""
        valve = (float(self["valve"]), said("the relief valve opens"), "above")
        return Featured("F_R free", ["R"], {"F_R free": (0.0, said("the shoe lifts off"), "below"), "P": valve})

    def rules(self, motion: Motion) -> list[Verdict]:
        """Return the paper's five criteria in words, over the following range of one design."""
        if motion._design_shape:
            return [Remark(said("The criteria are judged for one design at a time; this motion has a batch of them."))]
        return criteria(motion)


# The improved mechanism of figure 6: an arm that grows while the header rises matches needed and given pressure.


class ImprovedBalancer(HeaderBalancer):
    """Header 1 on a linkage whose arm H grows while the header rises, charged to just below its limit.

    Illustrative as all dimensions here: found by a search for the least spread of the reaction over the following range, such that it
    rises with the header, the pump keeps its reserve, and the cylinder's closed length suits its stroke.
    """

    h = Stroke(0.0, 0.25)  # m
    L_min = Dimension(0.56, unit="mm")
    L_OB = Dimension(1.20, unit="mm")
    L_OR = Dimension(2.665521, unit="mm")
    BOR = Dimension(13.055247 * deg, unit="deg")
    A = Ground(0.338, 0.433)
    G2 = OnLink("O", "B", OG2=2.137161, BOG2=28.184398 * deg)
    m2 = Dimension(2000 * kg, unit="kg")
    charge = Dimension(133.5 * kgf_cm2, unit="kgf/cm2")
    lift = Cylinder("A", "B", bore=63 * mm, rod=40 * mm, count=2, closed=0.56, stroke=0.25)


# The machine with a header at its published setting, and the table of settings for all headers.


def with_header(number: int, **changes: Any) -> HeaderBalancer:
    """Return the machine with a header at its published setting.

    Parameters
    ----------
    number : int
        Header 1, 2 or 3.
    **changes : float or array
        Other design variables [SI].

    Returns
    -------
    HeaderBalancer
        The machine.
    """
    if not is_whole(number) or number not in HEADERS:
        raise DefinitionError(f"Header {cited(number)} is unknown; the paper has {', '.join(map(str, HEADERS))}.")
    return HeaderBalancer(**{**HEADERS[number], **changes})


def setting_table(wanted: Sequence[float], changes: Mapping[str, Any] | None = None) -> list[Column]:
    """Return the charge pressure at the horizon for each header and each wanted reaction (35).

    Beside it is the reaction that is left, at the least, moving down over the following range. Another column says whether the setting
    keeps the largest charge without hang-up (1 yes, 0 no): slow, or fast where `changes` say n=1.4. NaN where the weights do not give so
    much reaction, or the line would be charged below every gas charge and be rigid.

    Parameters
    ----------
    wanted : sequence of float
        The reactions of all shoes [N].
    changes : mapping of str to object, optional
        Design variables [SI] of all headers.

    Returns
    -------
    list of Column
        The columns.
    """
    forces, changed = np.atleast_1d(numbers_in(wanted)), dict(changes or {})
    is_list = forces.size and forces.ndim == 1 and np.isfinite(forces).all()
    require(is_list, "wanted", wanted, "a list of finite reactions [N] is expected, such as [0.0, 100 * kgf]")
    design = HeaderBalancer(**changed)
    shoes, way = float(design["shoes"]), SLOW if design["n"] == 1.0 else Way(f"n = {design['n']:g}", exponent=float(design["n"]))
    columns = [Column("F_R", forces, "kgf", 0), Column(noted("per shoe"), forces / shoes, "kgf", 0)]
    for number in HEADERS:
        machine = with_header(number, **changed)
        motion = machine.at(h=0.0)
        limit = largest_charge(motion, way)
        charges, least = np.full(forces.shape, np.nan), np.full(forces.shape, np.nan)
        for place, force in enumerate(forces):
            with suppress(DefinitionError):  # not so much reaction; then, a rigid block or too weak a pump
                charges[place] = charge_for(motion, force)
                down = HeaderState(over_following(machine.replaced(charge=charges[place]).at(h=0.0))).down
                least[place] = float(np.min(down))
        columns += [
            Column(f"{noted('charge')} {number}", charges, "kgf/cm2", 2),
            Column(f"{noted('least')} {number}", least, "kgf", 0),
            Column(f"{noted('safe')} {number}", np.where(np.isnan(least), np.nan, charges <= limit), "", 0),
        ]
    return columns
