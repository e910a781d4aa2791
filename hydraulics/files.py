"""Gas laws and oil lines in mechanism files: a word, or a table of the law and its numbers; names and vessels in a list."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import singledispatch
from typing import Any

from linkage.errors import DefinitionError, cited, ensure, is_listed, known_name, require, unknown
from linkage.quantities import Member, is_number, name_of
from linkage.quantities.quantity import plain

from .gas import ROOM, Gas, Polytropic, RealNitrogen, adiabatic, isothermal, polytropic, real_nitrogen

LAWS: Mapping[str, tuple[Callable[..., Gas], tuple[str, ...]]] = {
    "isothermal": (lambda: isothermal, ()),
    "adiabatic": (lambda: adiabatic, ()),
    "polytropic": (polytropic, ("n", "temperature")),
    "real_nitrogen": (real_nitrogen, ("temperature",)),
}
"""The gas laws by name, each with the numbers it takes."""

EXAMPLE = '"isothermal" or { law = "polytropic", n = 1.2 }'


@singledispatch
def written_gas(gas: Gas) -> object:
    """Return a gas law as a file holds it; DefinitionError for one that it cannot."""
    raise DefinitionError(f"a file cannot hold the gas law {gas}; it knows {', '.join(LAWS)}.")


@written_gas.register
def _(gas: Polytropic) -> object:
    if gas.source_text in LAWS:
        return gas.source_text
    return {"law": "polytropic", "n": gas_number(gas.n), **temperature(gas)}


@written_gas.register
def _(gas: RealNitrogen) -> object:
    return {"law": "real_nitrogen", **temperature(gas)} if temperature(gas) else "real_nitrogen"


def temperature(gas: Gas) -> dict[str, object]:
    """Return the temperature of a law [K] where it is not the usual one."""
    return {} if gas.temperature == ROOM else {"temperature": gas_number(gas.temperature)}


def gas_number(value: object) -> object:
    """Return a number of a gas law; DefinitionError where there are several."""
    ensure(is_number(plain(value)), f"the gas law has several values, {value!r}; a file holds one design.")
    return plain(value)


# Kinds of arguments: how each is read and written, loaded when a file is.


def gas_kind() -> Any:
    """Return how a gas law is read, a word or a table, and written."""
    from linkage.files.entry import Kind, number_of

    def read(given: Any, names: Any) -> Gas:
        table = {"law": given} if isinstance(given, str) else given
        require(isinstance(table, Mapping) and isinstance(table.get("law"), str), "", given, f"is no gas law; write {EXAMPLE}")
        name = table["law"]
        known_name("Gas law", name, LAWS)
        make, keys = LAWS[name]
        for key in table:
            if key not in ("law", *keys):
                raise unknown(f"Key of {name}", key, keys)
        ensure(not ("n" in keys and "n" not in table), f"the exponent n of {name} is missing; write {EXAMPLE}.")
        return make(**{key: number_of(table[key], names) for key in keys if key in table})

    return Kind(read, lambda value, design, name: written_gas(value))


def on_line_kind(block: type[Any], *fittings: type[Any]) -> Any:
    """Return the kind of the parts of an oil line: names such as "lift.rod_side", and a table for each that has no name.

    That of accumulators is their own; one of `fittings` says its class as well, `{ Tank = [], pressure = "5 bar" }`.
    """
    from linkage.files.entry import Kind, Within, check_keys, made_of, read_table
    from linkage.files.source import Mistakes

    classes = {each.__name__: (each, Within.of(each)) for each in (block, *fittings)}

    def read(given: object, names: Any) -> tuple[Any, ...]:
        each_of = list(given) if is_listed(given) else [given]
        found: list[Any] = []
        for each in each_of:
            if isinstance(each, Mapping):
                mistakes = Mistakes()
                made, within = next((classes[key] for key in each if key in classes), classes[block.__name__])
                table = read_table(each, names, within.arguments, mistakes)
                check_keys(each, [*classes, *(argument.key for argument in within.arguments)], mistakes)
                mistakes.check()
                found.append(made(**made_of(table, within.arguments)))
            elif isinstance(each, str):
                found.append(each)
            else:
                raise DefinitionError(f'{cited(each)} is no name; write a list such as ["lift.piston_side", "supply"].')
        return tuple(found)

    def one(each: Any, design: Any) -> Any:
        word = type(each).__name__
        if word not in classes or (isinstance(each, Member) and each.name):
            return name_of(each) if isinstance(each, Member) else str(each)
        return ({} if word == block.__name__ else {word: []}) | classes[word][1].write(each, design, "")

    return Kind(read, lambda value, design, name: [one(each, design) for each in value], refers=True)


def filled_kind() -> Any:
    """Return how it is read and written where an oil line is filled: a word, a number, or numbers by name."""
    from linkage.files.entry import Kind, file_value, quantity_of

    def one(given: Any, names: Any) -> Any:
        found = quantity_of(given, names)
        return found if found.constant is None or found.name else found.constant

    def read(given: Any, names: Any) -> Any:
        if isinstance(given, Mapping):
            return {name: one(each, names) for name, each in given.items()}
        return given if given in ("open", "closed") else one(given, names)

    return Kind(read, file_value)


def pressure_kind(pump: type[Any]) -> Any:
    """Return how a pressure is read and written for which a pump may stand, by its name, or as a table where it has none."""
    from linkage.files.entry import Kind, amount

    plain, unnamed = amount("bar"), on_line_kind(pump)

    def read(given: Any, names: Any) -> Any:
        if isinstance(given, Mapping):
            return unnamed.read(given, names)[0]
        return given if isinstance(given, str) and names.kinds.get(given) == "load" else plain.read(given, names)

    def write(value: Any, design: Any, name: str) -> Any:
        found = design.plan.members.get(value) if isinstance(value, str) else value if isinstance(value, Member) else None
        return unnamed.write([value], design, name)[0] if isinstance(found, pump) else plain.write(value, design, name)

    return Kind(read, write)
