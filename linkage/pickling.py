"""Objects that hold nested functions, in a form that pickle can send to another process."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from importlib import import_module
from inspect import unwrap
from types import CellType, CodeType, FunctionType
from typing import Any

from .frozen import immutable

INSIDE = ".<locals>."


@immutable
class InnerFunction:
    """A nested function, by its place and its closure; unpickled it is the function."""

    module: str
    outer: str
    place: tuple[int, ...]
    defaults: tuple[object, ...] | None
    by_name: dict[str, object] | None
    cells: tuple[object, ...]

    def __call__(self, *given: object, **named: object) -> Any:
        """Call the function."""
        return function_again(*vars(self).values())(*given, **named)

    def __reduce__(self) -> tuple[object, ...]:
        return function_again, tuple(vars(self).values())


def function_again(
    module: str, outer: str, place: tuple[int, ...], defaults: Any, by_name: dict[str, object] | None, cells: tuple[object, ...]
) -> FunctionType:
    """Return a function that is nested in a function of a module."""
    code = code_of(module, outer)
    for each in place:
        code = code.co_consts[each]
    found = FunctionType(code, vars(import_module(module)), code.co_name, defaults, tuple(map(CellType, cells)))
    found.__kwdefaults__ = by_name
    found.__qualname__ = code.co_qualname
    return found


def code_of(module: str, outer: str) -> CodeType:
    """Return the code of a function of a module by its name there; AttributeError where there is none."""
    found: Any = import_module(module)
    for name in outer.split("."):
        found = vars(found)[name] if name in vars(found) else getattr(found, name)
        found = getattr(found, "fget", None) or getattr(found, "func", None) or getattr(found, "__func__", None) or found
    code: CodeType = unwrap(found).__code__
    return code


def picklable(value: object) -> Any:
    """Return a value that pickle can write: a nested function by its place, in a partial too; others as they are."""
    if isinstance(value, partial):
        named = {name: picklable(each) for name, each in value.keywords.items()}
        return partial(picklable(value.func), *map(picklable, value.args), **named)
    if not isinstance(value, FunctionType) or INSIDE not in value.__qualname__:
        return value
    outer = value.__qualname__.partition(INSIDE)[0]
    try:
        place = next((path for path, code in inner_codes(code_of(value.__module__, outer)) if code is value.__code__), None)
    except (AttributeError, ImportError):
        place = None
    if place is None:
        return value
    cells = tuple(picklable(cell.cell_contents) for cell in value.__closure__ or ())
    return InnerFunction(value.__module__, outer, place, value.__defaults__, value.__kwdefaults__, cells)


def inner_codes(code: CodeType, path: tuple[int, ...] = ()) -> Iterator[tuple[tuple[int, ...], CodeType]]:
    """Yield the codes within a code, however deep, each with its place among the constants."""
    for place, each in enumerate(code.co_consts):
        if isinstance(each, CodeType):
            yield (*path, place), each
            yield from inner_codes(each, (*path, place))


def object_of(kind: type, values: dict[str, object]) -> object:
    """Return an object of a class with these attributes."""
    found: Any = object.__new__(kind)
    vars(found).update(values)
    return found
