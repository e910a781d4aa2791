"""What a function does, as text: its code, that of its module which it calls, and the values that they read from outside.

It tells a changed `measure` from the one that a folder was begun with. Lines, comments and other modules do not enter.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator
from functools import partial, singledispatchmethod
from hashlib import blake2b
from types import CodeType, FunctionType, MethodType
from typing import Any

import numpy as np

from ..mechanism import Mechanism


def word(text: str | bytes) -> str:
    """Return a word of 32 characters for a text."""
    return blake2b(text.encode() if isinstance(text, str) else text, digest_size=16).hexdigest()


def fingerprint(function: Any) -> str:
    """Return a word for what a function does."""
    return word(Reader(function).text(function))


def plan_text(machine: Mechanism) -> str:
    """Return the members of a machine as text."""
    return re.sub(r" at 0x[0-9a-f]+", "", f"{type(machine).__qualname__}\n{machine.plan}")


class Reader:
    """Reads values as text. Of what is neither plain data nor a function of the first one's module only the name is read."""

    def __init__(self, first: Any) -> None:
        self.home = getattr(getattr(first, "func", first), "__module__", None)  # of a partial that of its function
        self.seen: set[int] = set()

    @singledispatchmethod
    def text(self, value: Any) -> str:
        """Return a value as text."""
        kind = type(value)
        called = getattr(kind, "__call__", None)  # noqa: B004 - the code of an object that is called like a function
        if isinstance(called, FunctionType) and kind.__module__ == self.home and id(value) not in self.seen:
            self.seen.add(id(value))
            return f"{kind.__qualname__} {self.text(called)} {self.text(vars(value))}"
        return str(getattr(value, "__qualname__", getattr(value, "__name__", kind.__qualname__)))

    @text.register(type(None))
    @text.register(int)
    @text.register(float)
    @text.register(complex)
    @text.register(str)
    @text.register(bytes)
    @text.register(np.generic)
    def _(self, value: Any) -> str:
        return repr(value)

    @text.register(list)
    @text.register(tuple)
    def _(self, value: Collection[Any]) -> str:
        return f"[{', '.join(map(self.text, value))}]"

    @text.register(set)
    @text.register(frozenset)
    def _(self, value: Collection[Any]) -> str:
        return f"{{{', '.join(sorted(map(self.text, value)))}}}"

    @text.register(dict)
    def _(self, value: dict[Any, Any]) -> str:
        return f"{{{', '.join(f'{self.text(key)}: {self.text(each)}' for key, each in value.items())}}}"

    @text.register(np.ndarray)
    def _(self, value: np.ndarray) -> str:
        return f"{value.dtype} {value.shape} {word(value.tobytes()) if value.dtype.kind != 'O' else ''}"

    @text.register(Mechanism)
    def _(self, value: Mechanism) -> str:
        return f"{plan_text(value)} {self.text(dict(value.dimensions))}"

    @text.register(partial)
    def _(self, value: partial[Any]) -> str:
        return self.text([value.func, value.args, value.keywords])

    @text.register(MethodType)
    def _(self, value: MethodType) -> str:
        return self.text([value.__func__, value.__self__])

    @text.register(FunctionType)
    def _(self, value: FunctionType) -> str:
        name = f"{value.__module__}.{value.__qualname__}"
        if value.__module__ != self.home or id(value) in self.seen:
            return name
        self.seen.add(id(value))
        outside = {each: value.__globals__[each] for each in sorted(names_in(value.__code__)) if each in value.__globals__}
        return self.text([name, *code_in(value.__code__), value.__defaults__, value.__kwdefaults__, *cells_of(value), outside])


def names_in(code: CodeType) -> set[str]:
    """Return the names that a code reads, the functions inside it included."""
    return {*code.co_names}.union(*(names_in(each) for each in code.co_consts if isinstance(each, CodeType)))


def code_in(code: CodeType) -> Iterator[Any]:
    """Yield the operations of a code, its names and its constants, of the functions inside it too."""
    yield from (code.co_code, code.co_names, code.co_varnames)
    for each in code.co_consts:
        yield from code_in(each) if isinstance(each, CodeType) else (each,)


def cells_of(function: FunctionType) -> Iterator[Any]:
    """Yield the values that a function closes over."""
    for cell in function.__closure__ or ():
        try:
            yield cell.cell_contents
        except ValueError:  # nothing in it yet
            yield None
