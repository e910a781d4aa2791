"""Gas accumulators on one line. Pressures are gauge [Pa] unless said to be absolute: the gas law works on gauge + atmosphere.

>>> from linkage.units import cm3, kgf_cm2, litre
>>> pair = [Accumulator(volume=4 * litre, charge=50 * kgf_cm2), Accumulator(volume=4 * litre, charge=25 * kgf_cm2)]
>>> block = AccumulatorBlock(pair, gas=isothermal, atmosphere=101325)
>>> print(f"{block.pressure(94 * kgf_cm2, withdrawn=200 * cm3) / kgf_cm2:.2f}")
88.48
>>> print(f"{block.fast_pressure(94 * kgf_cm2, withdrawn=200 * cm3) / kgf_cm2:.2f}")
86.36
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from copy import copy
from dataclasses import replace
from functools import cached_property, partial, reduce
from math import isfinite, nan
from types import MappingProxyType
from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike

from linkage.errors import DefinitionError, UnfitError, ensure, require_type
from linkage.frozen import immutable, keep_own
from linkage.language import said
from linkage.loads import Poses
from linkage.loads.element import value_text
from linkage.plan import Mask
from linkage.program import is_traced
from linkage.quantities import Dimension, Quantity, source_text
from linkage.units import cm3, litre, require_measure, show, unit_or_none, units_of
from linkage.verdict import Verdict

from .files import gas_kind
from .gas import Gas, Polytropic, isothermal
from .inputs import (
    Array,
    above_vacuum,
    all_finite,
    following,
    follows,
    in_pascals,
    not_negative,
    one_number,
    pose_values,
    positive,
    setting_of_designs,
)

VOLUME = "Accumulator volume"
LARGEST = 10.0
"""m3; the volume of a larger accumulator was given in litres."""
CHARGE = "Accumulator charge"


@immutable
class Accumulator:
    """A vessel charged with gas: `Accumulator(10 * litre, charge=94 * kgf_cm2)`.

    Parameters
    ----------
    volume : float, array or quantity
        The gas's volume with the fluid out [m3]. Of an array each design has one; 0 is an absent vessel.
    charge : float, array or quantity
        The gas's pressure then [Pa gauge], at the gas's temperature. In a class both may follow dimensions.

    Raises
    ------
    DefinitionError
        The volume is negative.
    """

    volume: Any
    charge: Any
    parameters: ClassVar[Mapping[str, str]] = MappingProxyType({"volume": "l", "charge": "bar"})

    def __post_init__(self) -> None:
        keep_own(self)
        for name, unit in self.parameters.items():
            require_measure(getattr(self, name), unit, f"Accumulator: {name}")
        volume = np.ones(()) if follows(self.volume) else not_negative(self.volume, VOLUME, "give 0 for a vessel that is absent")
        if np.any(volume > LARGEST):
            large = f"{np.max(volume):.6g}"
            raise DefinitionError(f"{VOLUME} = {large} m3 is more than any has; write {large} * litre if these are litres.")
        if not follows(self.charge):
            in_pascals(np.where(volume > 0.0, all_finite(self.charge, CHARGE), 0.0), CHARGE)

    def recharged(self, charge: Array | float) -> Accumulator:
        """Return the same vessel with another charge [Pa gauge], one that a gas law gives.

        Parameters
        ----------
        charge : float or ndarray
            The charge [Pa gauge].

        Returns
        -------
        Accumulator
            The vessel.
        """
        changed = copy(self)
        object.__setattr__(changed, "charge", charge)
        return changed

    def __str__(self) -> str:
        return f"Accumulator(volume={value_text(self.volume)}, charge={value_text(self.charge)})"


# -- several gas charges on one line ------------------------------------------------------------------------
#
# The exact piecewise law; every pressure in this part is absolute [Pa].
#
# A vessel of volume 0 is absent: it adds nothing to any sum, and its charge is not looked at.
#
# A gas of charge p_i fills its vessel V_i up to that pressure; above it, it holds V_i v(p)/v(p_i), v being the specific
# volume of the gas law. Between two charges the sum is (amount) v(p) + (idle volume), so its inverse is closed form
# for any gas law. Source: Rekhlitski, Chuprynin (2013), (17)-(33), for any number of charges.


@immutable
class GasBank:
    """Gas charges [Pa absolute] in vessels [m3], one of each per gas; a charge or volume may be an array over designs."""

    gas: Gas
    charges: tuple[Array, ...]
    vessels: tuple[Array, ...]

    @property
    def total(self) -> Array:
        """The gas volume with no fluid in, m3: the vessels."""
        return reduce(np.add, self.vessels)

    @property
    def lowest(self) -> Array:
        """The lowest charge of the vessels that are there, Pa: below it the bank holds no fluid."""
        highest = reduce(np.maximum, self.charges)
        return reduce(np.minimum, (np.where(vessel > 0.0, charge, highest) for charge, vessel in self))

    def __iter__(self) -> Iterator[tuple[Array, Array]]:
        """Yield the charge [Pa] and the vessel [m3] of each gas."""
        return zip(self.charges, self.vessels, strict=True)

    def gas_shares(self, pressure: Array) -> list[Array]:
        """Return the share of its vessel that each gas has at a pressure [Pa]; each of its shape."""
        return [self.gas.specific(np.maximum(pressure, charge)) / self.gas.specific(charge) for charge in self.charges]

    def volume(self, pressure: Array) -> Array:
        """Return the gas volume of the bank [m3] at a pressure [Pa], same shape."""
        # in the order of `total`: equal to it, not nearly, with no fluid in
        return reduce(np.add, (vessel * share for vessel, share in zip(self.vessels, self.gas_shares(pressure), strict=True)))

    def pressure(self, volume: Array) -> Array:
        """Return the pressure [Pa] at a gas volume [m3] above zero and not above `total`, same shape; the inverse of `volume`."""
        amount, idle = self._pieces(volume)
        return self.gas.pressure_of((volume - idle) / amount)

    def stiffness(self, volume: Array) -> Array:
        """Return -dp/dV [Pa/m3] at a gas volume [m3], same shape; where a gas joins, with it."""
        amount, idle = self._pieces(volume)
        return -1.0 / (amount * self.gas.slope(self.gas.pressure_of((volume - idle) / amount)))

    def _pieces(self, volume: Array) -> tuple[Array, Array]:
        """Return the amount of gas at work and the volume of the idle vessels [m3] at a gas volume of the bank [m3]."""
        amount = idle = np.zeros_like(volume)
        for charge, vessel in self:
            works = volume <= self.volume(charge)
            amount = amount + np.where(works, vessel / self.gas.specific(charge), 0.0)
            idle = idle + np.where(works, 0.0, vessel)
        return amount, idle


ROUNDING = 1e-12
"""Relative; a line charged to the lowest gas charge is not below it for a last digit."""

SMALLEST = 1e-9
"""Share of the gas volume below which no gas is left: no equation of a gas says what happens there."""


@immutable
class AccumulatorBlock:
    """Accumulators on one line, any number and any charges; pressures are gauge [Pa].

    Parameters
    ----------
    accumulators : sequence of Accumulator
        The vessels. One of volume 0 is absent. Below its charge an accumulator holds no fluid.
    gas : Gas, optional
        The gas law of all of them, isothermal by default.
    atmosphere : float, array or quantity, optional
        The air's pressure [Pa], which turns gauge into absolute, 101325 by default. With 0 gauge pressures go straight into the law, as
        Rekhlitski and Chuprynin (2013) do.
    unit : str, optional
        The unit of pressures in sentences. Without it that of the dimension that a charge follows, else bar.

    Raises
    ------
    DefinitionError
        There is no accumulator, `gas` is no gas law, or a charge is at or below zero absolute.

    Notes
    -----
    Where a charge, a volume or the atmosphere follows dimensions, `sized(motion)` is the block with numbers.
    """

    accumulators: Sequence[Accumulator]
    gas: Gas = isothermal
    atmosphere: Any = 101325.0
    unit: str = ""
    parameters: ClassVar[Mapping[str, str]] = MappingProxyType({"atmosphere": "Pa"})
    argument_kinds: ClassVar[Mapping[str, Any]] = MappingProxyType({"accumulators": (Accumulator,), "gas": gas_kind})

    def __post_init__(self) -> None:
        require_type("", self.accumulators, (list, tuple), "is no list of accumulators; write AccumulatorBlock([Accumulator(...)])")
        object.__setattr__(self, "accumulators", tuple(self.accumulators))
        keep_own(self)
        ensure(self.accumulators, "The accumulator block is empty; give it at least one Accumulator(volume, charge).")
        for one in self.accumulators:
            require_type("", one, Accumulator, "is no Accumulator; write Accumulator(volume, charge)")
        require_type("gas", self.gas, Gas, "is no gas law; take isothermal, adiabatic, polytropic(1.2) or real_nitrogen()")
        unit_or_none(self.unit, "The accumulator block", units_of("pressure"))
        if not follows(self.atmosphere) and np.any(one_atmosphere(self.atmosphere) < 0.0):
            raise DefinitionError(f"Atmosphere = {self.atmosphere:.6g} Pa is below zero; give 101325, or 0 for the paper's way.")
        if not follows(self.atmosphere):
            in_pascals(self.atmosphere, "Atmosphere")
        if not self.following:
            for charge in self._bank.charges:
                positive(charge, "Absolute accumulator charge", "give the charge as gauge pressure [Pa]; an accumulator needs gas")

    @property
    def following(self) -> tuple[Quantity, ...]:
        """The quantities that its charges, its volumes and the atmosphere follow, where they are no numbers."""
        return following(self.atmosphere, *(value for one in self.accumulators for value in (one.volume, one.charge)))

    def sized(self, motion: Poses) -> AccumulatorBlock:
        """Return the block as a motion's designs have it; charges and volumes broadcast against the motion.

        Parameters
        ----------
        motion : Motion
            The poses; designs first, strokes last.

        Returns
        -------
        AccumulatorBlock
            The block.
        """
        if not self.following:
            return self
        unit = self.unit
        if not unit:  # that of the first dimension which a charge follows
            charges = following(*(one.charge for one in self.accumulators))
            names = {name for charge in charges for name in motion.plan.reaches(charge.name or charge)}
            units = [member.unit for name, member in motion.plan.of_kind(Dimension).items() if name in names]
            unit = next((each for each in units if each in units_of("pressure")), "")
        filled = [
            Accumulator(setting_of_designs(motion, each.volume, VOLUME), setting_of_designs(motion, each.charge, CHARGE))
            for each in self.accumulators
        ]
        atmosphere = one_atmosphere(setting_of_designs(motion, self.atmosphere, "Atmosphere"))[()]
        return replace(self, accumulators=filled, atmosphere=atmosphere, unit=unit)

    def __str__(self) -> str:
        vessels = ", ".join(map(str, self.accumulators))
        unit = f", unit={self.unit!r}" if self.unit else ""
        return f"AccumulatorBlock([{vessels}], gas={self.gas.source_text}, atmosphere={value_text(self.atmosphere)}{unit})"

    def gas_volume(self, pressure: ArrayLike) -> Array:
        """Return the gas volume [m3] at a pressure, same shape. DefinitionError below zero absolute or outside the gas law.

        Parameters
        ----------
        pressure : array_like
            The pressure [Pa gauge].

        Returns
        -------
        ndarray
            The volume [m3].

        Raises
        ------
        DefinitionError
            A pressure below zero absolute, or outside the gas law.
        """
        return self._bank.volume(self._absolute(pressure))[()]

    def fluid(self, pressure: ArrayLike) -> Array:
        """Return the fluid held [m3] at a pressure, same shape; 0 below every charge. Errors as `gas_volume`.

        Parameters
        ----------
        pressure : array_like
            The pressure [Pa gauge].

        Returns
        -------
        ndarray
            The volume [m3].
        """
        bank = self._bank
        return (bank.total - bank.volume(self._absolute(pressure)))[()]

    def pressure(self, p1: ArrayLike, withdrawn: ArrayLike = 0.0) -> Array:
        """Return the pressure after `withdrawn` [m3] has left the block charged to `p1`; negative is pushed in.

        The two broadcast. 0 where more is withdrawn than the block holds: the line is empty. NaN in an array `withdrawn`
        stays NaN. DefinitionError where `p1` is below every gas charge (the block is rigid), where the volume
        pushed in leaves no gas, or where the gas law ends.

        Parameters
        ----------
        p1 : array_like
            The pressure before [Pa gauge].
        withdrawn : array_like
            The volume that leaves the block [m3]; negative where it is pushed in.

        Returns
        -------
        ndarray
            The pressure [Pa gauge].

        Raises
        ------
        DefinitionError
            `p1` is below every charge, no gas is left, or the gas law ends.
        """
        return self._pressure_in(self._gas_after(p1, withdrawn))

    def pressure_holding(self, fluid: ArrayLike) -> Array:
        """Return the pressure at which the block holds `fluid` [m3], same shape: inverts `fluid`, from the lowest charge on.

        With `at` this is what a trapped line does when it warms up: `block.at(T).pressure_holding(block.fluid(p1))`.
        DefinitionError for a negative volume, or one that leaves no gas.

        Parameters
        ----------
        fluid : array_like
            The volume of fluid [m3].

        Returns
        -------
        ndarray
            The pressure [Pa gauge].

        Raises
        ------
        DefinitionError
            A negative volume, or one that leaves no gas.
        """
        held = pose_values(fluid, "Fluid held", "volume")
        if np.any(held < -ROUNDING * self._bank.total):  # `fluid` is a difference of volumes, which may round below none
            raise DefinitionError(f"Fluid held = {np.nanmin(held) / cm3:.6g} cm3 is below zero; the block cannot hold less than none.")
        return self._pressure_in(self._gas_left(self._bank.total, np.maximum(held, 0.0)))

    def stiffness(self, p1: ArrayLike, withdrawn: ArrayLike = 0.0) -> Array:
        """Return -dp/d(withdrawn) [Pa/m3], exact, in the state of `pressure`; 0 where the line is empty.

        At the pressure where an accumulator joins it is the softer of the two values. Errors as `pressure`.

        Parameters
        ----------
        p1 : array_like
            The pressure before [Pa gauge].
        withdrawn : array_like
            The volume that leaves the block [m3]; negative where it is pushed in.

        Returns
        -------
        ndarray
            The stiffness [Pa/m3].
        """
        bank, volume = self._bank, self._gas_after(p1, withdrawn)
        return np.where(volume > bank.total, 0.0, bank.stiffness(np.minimum(volume, bank.total)))[()]

    def settled(self, p1: ArrayLike, exponent: ArrayLike | None = None) -> AccumulatorBlock:
        """Return the block as it answers a fast movement, after it has slowly settled at `p1` by its own law.

        Accumulators at work follow p V^n = const from there, so they run empty below their charge, cooled. The others join
        at their charge. n is `exponent`, or what the gas gives at `p1`: 1.4 for ideal gas, the isentropic exponent for real
        nitrogen. That is good to 2 % of the pressure over a change of volume by a third at 100 bar, to 5 % at 200 bar.
        An array `p1` gives one design per element. DefinitionError where the block is rigid or n is outside 1..10.

        Parameters
        ----------
        p1 : array_like
            The pressure before [Pa gauge].
        exponent : array_like, optional
            The exponent of the fast change; by default that of the gas at `p1`.

        Returns
        -------
        AccumulatorBlock
            The block after it has settled.

        Raises
        ------
        DefinitionError
            The block is rigid, or the exponent is outside 1 to 10.
        """
        bank, pressure = self._bank, self._charged(p1)
        n = self.gas.fast_exponent(pressure) if exponent is None else all_finite(exponent, "Exponent of the fast change")
        shares = zip(bank.charges, bank.gas_shares(pressure), strict=True)
        cooled = [np.maximum(pressure, charge) * share**n for charge, share in shares]
        emptied = [one.recharged(charge - self.atmosphere) for one, charge in zip(self.accumulators, cooled, strict=True)]
        return replace(self, accumulators=emptied, gas=Polytropic(n, self.gas.temperature))

    def fast_pressure(self, p1: ArrayLike, withdrawn: ArrayLike = 0.0, exponent: ArrayLike | None = None) -> Array:
        """Return the pressure after a fast movement has withdrawn a volume [m3] from the block settled at `p1`.

        As `pressure`, of the block `settled(p1, exponent)`.

        Parameters
        ----------
        p1 : array_like
            The pressure before [Pa gauge].
        withdrawn : array_like
            The volume that leaves the block [m3]; negative where it is pushed in.
        exponent : array_like, optional
            The exponent of the fast change; by default that of the gas at `p1`.

        Returns
        -------
        ndarray
            The pressure [Pa gauge].
        """
        return self.settled(p1, exponent).pressure(p1, withdrawn)

    def charges_at(self, temperature: ArrayLike) -> Array:
        """Return the charges at gas temperatures [K], shape (accumulators, ...): the setting table of the same gas filling.

        NaN for an absent vessel.

        Parameters
        ----------
        temperature : array_like
            The temperatures [K].

        Returns
        -------
        ndarray
            The charges [Pa gauge], shape (accumulators, ...).
        """
        pressures = [np.where(vessel > 0.0, self.gas.charge_at(charge, temperature), np.nan) for charge, vessel in self._bank]
        return np.asarray(np.stack(np.broadcast_arrays(*pressures)) - self.atmosphere)

    def at(self, temperature: float) -> AccumulatorBlock:
        """Return the same gas filling at another temperature [K]. DefinitionError for one outside the gas law.

        Parameters
        ----------
        temperature : float
            The temperature of the gas [K].

        Returns
        -------
        AccumulatorBlock
            The block at that temperature.

        Raises
        ------
        DefinitionError
            A temperature outside the gas law.
        """
        charges = self.charges_at(temperature)
        pairs = zip(self.accumulators, charges, strict=True)
        warmed = [one.recharged(np.where(one.volume > 0.0, charge, one.charge)[()]) for one, charge in pairs]
        return replace(self, accumulators=warmed, gas=self.gas.at(temperature))

    def checks(
        self, p_min: float, p_max: float, allowed: float, unit: str = "", recharged: Callable[[int, str], float] | None = None
    ) -> list[Verdict]:
        """Return the accumulator rules for a line working from `p_min` to `p_max`, `allowed` the highest permitted, all gauge.

        An array charge is judged by its worst element, absent vessels not at all; `unit` is for the sentences, without it
        the block's own. `recharged` tells the charge [Pa gauge] with which a line keeps a rule, where its pressures go with it.
        DefinitionError for `p_min` above `p_max`, an unknown unit.

        Parameters
        ----------
        p_min : float
            The least pressure [Pa gauge].
        p_max : float
            The greatest pressure [Pa gauge].
        allowed : float
            The highest permitted pressure [Pa gauge].
        unit : str
            The unit of the sentences.
        recharged : callable, optional
            Returns the charge [Pa gauge] with which a line keeps a rule.

        Returns
        -------
        list of Verdict
            The verdicts.

        Raises
        ------
        DefinitionError
            `p_min` above `p_max`, or an unknown unit.
        """
        unit_or_none(unit, "checks(unit=...)", units_of("pressure"))
        given = (one_number(pressure, "Pressure", "pressure") for pressure in (p_min, p_max, allowed))
        low, high, limit = (float(self._absolute(pressure)) - self.atmosphere for pressure in given)
        text = partial(show, unit=unit or self.unit or "bar", digits=4)
        ensure(not low > high, f"p_min = {text(low)} is above p_max = {text(high)}; exchange them.")
        each_of = enumerate((np.broadcast_arrays(*each) for each in self._bank), 1)
        charges = {number: charge[vessel > 0.0] for number, (charge, vessel) in each_of if np.any(vessel > 0.0)}
        pressures = {"charge": low + self.atmosphere, "compression": high + self.atmosphere}
        found = []
        for rule, ends in zip(pressures, (np.max, np.min), strict=True):
            found += [self._rule(rule, n, float(ends(charge)), pressures, text, recharged) for n, charge in charges.items()]
        held = float(np.min(self.fluid(p_min)))
        says = said("{fluid} of fluid left at the lowest pressure, {low} gauge", fluid=show(held, "cm3", 4), low=text(low))
        remedy = "" if held > 0.0 else said("; lower a charge, or charge the line higher")
        found.append(Verdict("exhausted", held > 0.0, f"{says}{remedy}."))
        highest = text(high, missed=None if high <= limit else limit)
        says = said("highest pressure {high}, allowed {allowed} (gauge)", high=highest, allowed=text(limit))
        remedy = "" if high <= limit else said("; set the relief valve lower or take a stronger accumulator")
        return [*found, Verdict("allowed pressure", high <= limit, f"{says}{remedy}.")]

    def _rule(
        self, rule: str, number: int, charge: float, pressures: Mapping[str, float], text: Callable[[float], str],
        recharged: Callable[[int, str], float] | None,
    ) -> Verdict:  # fmt: skip
        """Return whether an accumulator's charge keeps a rule at the pressure of it [Pa absolute], else the charge that keeps all rules."""

        def gauge(absolute: float) -> str:
            return said("{pressure} gauge", pressure=text(absolute - self.atmosphere))

        is_low, pressure = rule == "charge", pressures[rule]
        if is_low:
            most, heading = text(CHARGE_SHARE * pressure), said("charge of accumulator {n}", n=number)
            by = {"charge": text(charge), "most": most, "share": CHARGE_SHARE}
            says = said("{charge} against {most}, {share:g} of the lowest pressure (absolute)", **by)
        else:
            high, heading = text(pressure), said("compression of accumulator {n}", n=number)
            by = {"high": high, "ratio": pressure / charge, "limit": COMPRESSION}
            says = said("{high} at most is {ratio:.4g} times the charge, limit {limit:g} (absolute)", **by)
        if keeps_rule(rule, charge, pressure):
            return Verdict(f"{rule} of accumulator {number}", True, f"{says}.", heading)
        possible = gauge(charge / CHARGE_SHARE if is_low else COMPRESSION * charge)
        own = CHARGE_SHARE * pressure if is_low else pressure / COMPRESSION
        if recharged is not None:
            own = recharged(number, rule) + self.atmosphere
        elif pressures["compression"] > RANGE * pressures["charge"]:
            own = nan
        if is_low and charge >= pressure:
            says += said("; it is idle there, full of gas")
        words = {"possible": possible, "wanted": gauge(own), "ratio": RANGE}
        if not isfinite(own):
            remedy = said("; no charge suits: take larger ones, until the highest pressure is {ratio:g} times the lowest", **words)
        elif is_low:
            remedy = said("; lower the charge to {wanted}, or raise the lowest pressure to {possible}", **words)
        else:
            remedy = said("; raise the charge to {wanted}, or lower the highest pressure to {possible}", **words)
        return Verdict(f"{rule} of accumulator {number}", False, f"{says}{remedy}.", heading)

    @cached_property
    def _bank(self) -> GasBank:
        self._check_sized()
        vessels = [not_negative(one.volume, VOLUME) for one in self.accumulators]
        if np.any(reduce(np.add, vessels) <= 0.0):
            raise DefinitionError("Every accumulator of the block has the volume 0, it is absent; give one of them a volume above zero.")
        given = [all_finite(one.charge, CHARGE, "pressure") + self.atmosphere for one in self.accumulators]
        other = reduce(np.maximum, (np.where(vessel > 0.0, charge, 0.0) for charge, vessel in zip(given, vessels, strict=True)))
        charges = []
        for charge, vessel in zip(given, vessels, strict=True):
            absent = vessel <= 0.0  # whatever its charge, no gas has it; what is traced keeps it where there can be a gas of it
            absent = absent & (charge <= 0.0) if is_traced(vessel) else absent
            own = np.where(absent, other, charge) if is_traced(vessel) or np.any(absent) else charge
            charges.append(above_vacuum(own, self.atmosphere, CHARGE))
        return GasBank(self.gas, tuple(charges), tuple(vessels))

    @property
    def lowest_charge(self) -> Array:
        """The lowest charge [Pa gauge] of the vessels that are there: charged to less, the block is rigid."""
        return np.asarray(self._bank.lowest - self.atmosphere)[()]

    def _check_sized(self) -> None:
        if self.following:
            names = ", ".join(map(source_text, self.following))
            raise DefinitionError(f"{self}: it follows {names}; ask sized(motion) for the block of a design.")

    def _absolute(self, pressure: ArrayLike) -> Array:
        self._check_sized()
        return above_vacuum(all_finite(pressure, "Pressure", "pressure") + self.atmosphere, self.atmosphere, "Pressure")

    def _charged(self, p1: ArrayLike) -> Array:
        """Return `p1` as absolute pressure [Pa]; DefinitionError where the block is rigid."""
        pressure, lowest = self._absolute(p1), self._bank.lowest
        rigid = pressure < lowest * (1.0 - ROUNDING)
        if np.any(rigid):
            p, charge = (float(np.broadcast_to(of, rigid.shape)[rigid][0] - self.atmosphere) for of in (pressure, lowest))
            low, least = (show(each, self.unit or "bar", 4) for each in (p, charge))
            raise UnfitError(
                f"The block is rigid: charged to {low} gauge it holds no fluid, its lowest gas charge being {least} gauge. "
                f"Charge the line above {least}, or lower a gas charge."
            )
        return pressure

    def _gas_after(self, p1: ArrayLike, withdrawn: ArrayLike) -> Array:
        """Return the gas volume [m3] after a withdrawal; beyond the block's total where the line is empty."""
        return self._gas_left(self._bank.volume(self._charged(p1)), -pose_values(withdrawn, "Withdrawn volume", "volume"))

    def _gas_left(self, gas: Array, pushed: Array) -> Array:
        """Return the gas volume [m3] after fluid [m3] is pushed in; DefinitionError where it leaves no gas."""
        left = gas - pushed
        crushed = left <= SMALLEST * gas
        if np.any(crushed):
            there, came = (float(np.broadcast_to(of, crushed.shape)[crushed][0]) / litre for of in (gas, pushed))
            raise UnfitError(
                f"Pushing {came:.4g} litres of fluid into a block with {there:.4g} litres of gas leaves no gas; "
                "take larger accumulators, a lower pressure or a shorter travel."
            )
        return left

    def _pressure_in(self, volume: Array) -> Array:
        """Return the gauge pressure [Pa] at a gas volume [m3], same shape; 0 beyond the block's total."""
        bank = self._bank
        pressure = bank.pressure(np.minimum(volume, bank.total)) - self.atmosphere
        return np.where(volume > bank.total, 0.0, pressure)[()]


def one_atmosphere(atmosphere: ArrayLike) -> Array:
    """Return the atmosphere [Pa]; DefinitionError where a batch gives several."""
    ensure(not np.ndim(atmosphere), "atmosphere is one number for all designs of a batch; give a float.")
    return all_finite(atmosphere, "Atmosphere", "pressure")


# -- the rules an accumulator is chosen by, each with a verdict --------------------------------------------
#
# Source: makers' sizing rules for bladder accumulators (HYDAC, Olaer): charge at most 0.9 of the lowest working
# pressure, so that the bladder does not strike the valve; highest working pressure at most 4 times the charge,
# so that it is not overstretched. Both compare absolute pressures; what is to be set is said as gauge pressure.

CHARGE_SHARE = 0.9
COMPRESSION = 4.0
RANGE = CHARGE_SHARE * COMPRESSION
"""The highest pressure over the lowest one [absolute] that one charge bears by both rules."""


def keeps_rule(rule: str, charge: Array | float, pressure: Array | float) -> Mask | bool:
    """Return whether a charge suits the lowest pressure, rule "charge", or the highest one, rule "compression" [Pa absolute]."""
    return charge <= CHARGE_SHARE * pressure if rule == "charge" else pressure <= COMPRESSION * charge
