"""Gas laws in mechanism files: a word, or a table of the law and its numbers."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import singledispatch
from typing import Any, final

from linkage.errors import DefinitionError, cited, unknown
from linkage.quantities import is_number
from linkage.quantities.quantity import plain

from .gas import ROOM, Gas, Polytropic, adiabatic, isothermal, polytropic
from .nitrogen import RealNitrogen, real_nitrogen

LAWS: Mapping[str, tuple[Callable[..., Gas], tuple[str, ...]]] = {
    "isothermal": (lambda: isothermal, ()),
    "adiabatic": (lambda: adiabatic, ()),
    "polytropic": (polytropic, ("n", "temperature")),
    "real_nitrogen": (real_nitrogen, ("temperature",)),
}
"""The gas laws by name, each with the numbers it takes."""

EXAMPLE = '"isothermal" or { law = "polytropic", n = 1.2 }'


def gas_of(given: Any, number: Callable[[Any], float]) -> Gas:
    """Return the gas law that a word or a table says; `number` reads a number of it."""
    table = {"law": given} if isinstance(given, str) else given
    if not isinstance(table, Mapping) or not isinstance(table.get("law"), str):
        raise DefinitionError(f"{cited(given)} is no gas law; write {EXAMPLE}.")
    name = table["law"]
    if name not in LAWS:
        raise unknown("Gas law", name, LAWS)
    make, keys = LAWS[name]
    for key in table:
        if key not in ("law", *keys):
            raise unknown(f"Key of {name}", key, keys)
    if "n" in keys and "n" not in table:
        raise DefinitionError(f"the exponent n of {name} is missing; write {EXAMPLE}.")
    return make(**{key: number(table[key]) for key in keys if key in table})


@singledispatch
def written_gas(gas: Gas) -> Any:
    """Return a gas law as a file holds it; DefinitionError for one that it cannot."""
    raise DefinitionError(f"a file cannot hold the gas law {gas}; it knows {', '.join(LAWS)}.")


@written_gas.register
def _(gas: Polytropic) -> Any:
    if gas.spelled in LAWS:
        return gas.spelled
    return {"law": "polytropic", "n": gas_number(gas.n), **temperature(gas)}


@written_gas.register
def _(gas: RealNitrogen) -> Any:
    return {"law": "real_nitrogen", **temperature(gas)} if temperature(gas) else "real_nitrogen"


def temperature(gas: Gas) -> dict[str, Any]:
    """Return the temperature of a law [K] where it is not the usual one."""
    return {} if gas.temperature == ROOM else {"temperature": gas_number(gas.temperature)}


def gas_number(value: Any) -> Any:
    """Return a number of a gas law; DefinitionError where there are several."""
    if not is_number(plain(value)):
        raise DefinitionError(f"the gas law has several values, {value!r}; a file holds one design.")
    return plain(value)


@final
class GasLaw:
    """What stands in the place of a gas law: how it is read from a file, and written into one."""

    read = staticmethod(gas_of)
    write = staticmethod(written_gas)
