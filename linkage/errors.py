"""Errors: every deliberate failure with its fault, its place, and the remedy; and the checks at public doors, in one form of words."""

from __future__ import annotations

import math
import sys
import warnings
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from difflib import get_close_matches
from traceback import walk_tb
from typing import TYPE_CHECKING, Any, TypeGuard, TypeVar, cast

if TYPE_CHECKING:
    import numpy.typing as npt

    from .vectors import FloatArray, Scalar

Kind = TypeVar("Kind")
Result = TypeVar("Result")


class LinkageError(Exception):
    """The base of every error that this framework raises on purpose.

    Parameters
    ----------
    message : str, optional
        What is wrong, where, and what to do.
    member : str, optional
        The name of the member that it is about, "" of none.
    """

    def __init__(self, message: str = "", *, member: str = "") -> None:
        super().__init__(message)
        self.member = member


@contextmanager
def about(member: str) -> Iterator[None]:
    """Mark every error that comes from inside as one about a member, unless it says already which one it is about."""
    try:
        yield
    except LinkageError as error:
        error.member = error.member or member
        raise


class DefinitionError(LinkageError, ValueError):
    """A class, a file or a setting is impossible. `member` is the name of the member at fault, "" where it is no single one."""


class UnfitError(DefinitionError):
    """The numbers of a design leave no answer, as of a gas block that is too small: a verdict says so, with the remedy."""


class LawError(DefinitionError):
    """The law of a load has values over a motion, and cannot be traced into a program."""


class UntracedError(DefinitionError):
    """A request has values over a motion, but no program that gives them pose by pose, with derivatives."""


class AssemblyError(LinkageError):
    """The mechanism cannot be assembled at some strokes.

    Parameters
    ----------
    message : str
        What is wrong, where, and what to do.
    point : str, optional
        The name of what could not be placed.
    mask : array of bool, optional
        The poses that are not reached (True), of the shape of the motion.
    shortfall : float, optional
        The largest missing length [m], NaN where it is not a length.
    """

    def __init__(self, message: str, *, point: str = "", mask: npt.ArrayLike | None = None, shortfall: float = float("nan")) -> None:
        super().__init__(message, member=point)
        self.point = point
        import numpy as np  # here, so that who only reads names, as `hydrolinkage list` does, is spared it

        self.mask = np.zeros((), bool) if mask is None else np.asarray(mask, bool)
        self.shortfall = shortfall


class SingularError(AssemblyError):
    """A ratio or a force was asked for at a singular pose.

    Parameters
    ----------
    message : str
        What is wrong, where, and what to do.
    point : str, optional
        The name of what has no ratio or force there.
    mask : array of bool, optional
        The singular poses (True), of the shape of the motion.
    motion : Motion, optional
        The motion, whose positions stay available.
    """

    def __init__(self, message: str, *, point: str = "", mask: npt.ArrayLike | None = None, motion: object = None) -> None:
        super().__init__(message, point=point, mask=mask)
        self.reason = message
        self.motion = motion


class SingularWarning(UserWarning):
    """A pose so near to a singular one that digits are lost.

    Parameters
    ----------
    message : str, optional
        What loses digits, and where.
    estimate : float, optional
        The relative error to expect.
    """

    def __init__(self, message: str = "", *, estimate: float = float("nan")) -> None:
        super().__init__(message)
        self.estimate = estimate


def warn(warning: SingularWarning) -> None:
    """Warn at the line that called the package, however many of its functions lie between."""
    frame, level = sys._getframe(1), 2
    while str(frame.f_globals.get("__name__")).partition(".")[0] == __package__ and frame.f_back is not None:
        frame, level = frame.f_back, level + 1
    warnings.warn(warning, stacklevel=level)


@contextmanager
def unwarned() -> Iterator[None]:
    """Leave out the warnings of poses near singular ones, where their consequences are reported in another way."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SingularWarning)
        yield


def heard(make: Callable[[], Result]) -> tuple[Result, list[SingularWarning]]:
    """Return the result of a function and its warnings near singular poses, which are not given."""
    with warnings.catch_warnings(record=True) as every:
        warnings.simplefilter("always", SingularWarning)
        made = make()
    for each in every:
        if not isinstance(each.message, SingularWarning):
            warnings.warn_explicit(each.message, each.category, each.filename, each.lineno)
    return made, [each.message for each in every if isinstance(each.message, SingularWarning)]


@contextmanager
def errors_of(what: str) -> Iterator[None]:
    """Turn any error in a user's own function into a DefinitionError with its name and the line."""
    try:
        yield
    except (LinkageError, MemoryError):
        raise
    except Exception as error:
        where, hint = culprit(error)
        raise DefinitionError(f"{what} raises {type(error).__name__}: {error} ({where}); mend it there.{hint}") from error


ASKED = "__getattr__", "late_name"
"""The functions that look up a name for another place, which is the one that misspelt it."""


def culprit(error: BaseException) -> tuple[str, str]:
    """Return where an error comes from, and " Did you mean ...?" with the nearest name where one is misspelt there, else ""."""
    frame, line = [each for each in walk_tb(error.__traceback__) if each[0].f_code.co_name not in ASKED][-1]
    names: list[str] = []
    if isinstance(error, NameError):
        names = [*frame.f_locals, *frame.f_globals, *frame.f_builtins]
    elif isinstance(error, AttributeError):
        names = [each for each in dir(error.obj) if not each.startswith("_")]
    return f"{frame.f_code.co_filename}, line {line}", did_you_mean(getattr(error, "name", None), names)


class FileError(LinkageError):
    """A file that cannot be understood: the line or the key, and the remedy."""


class StudyError(LinkageError):
    """A study stopped before its end.

    Parameters
    ----------
    message : str
        The reason, and whether the study can go on from there.
    designs : tuple of int, optional
        The first and the last design of the part that failed, where it was one of them; the cause is chained.
    """

    def __init__(self, message: str, *, designs: tuple[int, int] | None = None) -> None:
        super().__init__(message)
        self.designs = designs


def cited(value: object, most: int = 60, quote: bool = True) -> str:
    """Return a value as a message shows it: on one line, cut where it is long, a text without quotes where it is no quotation."""
    try:
        text = " ".join(repr(cast(Any, value).item() if getattr(value, "ndim", None) == 0 else value).split())
    except (ValueError, RecursionError):
        text = f"an endless {type(value).__name__}"
    text = text if quote or not isinstance(value, str) else text[1:-1]
    return text if len(text) <= most else f"{text[: most - 3]}..."


def known_name(kind: str, name: object, names: Collection[str], where: str = "") -> str:
    """Return a name that is there; raise the error of `unknown` for anything else."""
    aliases: Mapping[str, str] = getattr(names, "aliases", {})
    if isinstance(name, str) and name in aliases:
        return aliases[name]
    if not isinstance(name, str) or name not in names:
        raise unknown(kind, name, names, where)
    return name


def article(word: str) -> str:
    """Return the article that goes with a word."""
    return "an" if word[0] in "aeiou" else "a"


def quoted(word: str) -> str:
    """Return a word in the quotes that it is written with."""
    return f'"{word}"'


def one_word(what: str, word: object, words: Sequence[str]) -> str:
    """Return a word that is one of a few; DefinitionError, with the words there are, for anything else."""
    if not isinstance(word, str) or word not in words:
        raise DefinitionError(f"{what}={cited(word)}: say {' or '.join(map(quoted, words))}.")
    return word


def ensure(holds: object, message: str) -> None:
    """Raise DefinitionError, in words that say what, where and the remedy, unless something holds."""
    if not holds:
        raise DefinitionError(message)


def is_yes(name: str, given: object) -> bool:
    """Return an option that is True or False; DefinitionError for anything else."""
    if not isinstance(given, bool):
        raise DefinitionError(f"{name}={cited(given)}: True or False is expected.")
    return given


FIELD_WORDS = {
    "bore": "diameter piston piston_diameter",
    "rod": "diameter rod_diameter",
    "thrust": "force load",
    "drive_force": "force torque",
    "mass": "weight force load",
    "stroke": "travel displacement length",
    "distance": "length",
    "pressure": "pump supply",
    "flow": "volume delivery displacement rate",
    "stiffness": "rate",
    "ratio": "leverage",
    "reserve": "safety",
}
"""What the field calls some things beside their names here."""


def did_you_mean(name: object, names: Sequence[str]) -> str:
    """Return " Did you mean ...?" with the nearest of some names, of the same member first; "" where none is near."""
    if not isinstance(name, str):
        return ""
    whose, _, word = name.rpartition(".")
    other = [own for own, words in FIELD_WORDS.items() if word.lower() in words.split()]
    near = [each for own in other for each in names if each.replace(" ", "_") in (own, f"{whose}.{own}")]
    near = near or [each for own in other for each in names if each.rpartition(".")[2] == own][:3]
    if not near and " " not in name:  # a heading without its member, `pressure` for `pressure lift`
        heads = get_close_matches(name, {each.partition(" ")[0] for each in names if " " in each}, n=1, cutoff=0.8)
        near = [each for each in names if each.partition(" ")[0] in heads][:3]
    if not near:  # of a member that is there, one of its own
        own = {each: each.removeprefix(f"{whose}.") for each in names if whose and each.startswith(f"{whose}.")}
        close = get_close_matches(word if own else name, [*own.values()] or names, n=1, cutoff=0.5)
        near = [f"{whose}.{each}" for each in close] if own else close
    if not near:  # a word of longer names
        words = get_close_matches(name, {word for each in names for word in each.split("_")}, n=1, cutoff=0.8)
        near = [each for each in names if {*each.split("_")} & {*words}][:3]
    return f" Did you mean {' or '.join(near)}?" if near else ""


def unknown(kind: str, name: object, known: Iterable[str], where: str = "", *, member: str = "") -> DefinitionError:
    """Return the error for a name that is not there: it lists the valid names and the nearest one; `member` is whose part it is."""
    names = list(known)
    point, _, axis = name.rpartition("_") if isinstance(name, str) else ("", "", "")
    is_heading = kind == "Name" and axis in ("x", "y") and point in names  # as tables and files head a point's coordinate
    hint = f' The coordinate is motion.{axis}("{point}"), in requests {axis}("{point}").' if is_heading else did_you_mean(name, names)
    place = f" in {where}" if where else ""
    listing = ", ".join(names) if names else "none"
    return DefinitionError(f"{kind} {cited(name)} is unknown{place}.{hint} Known: {listing}.", member=member)


class FormerName:
    """An attribute by the name that it had before: it gives what has the new name, with a warning, for one release."""

    def __init__(self, name: str) -> None:
        self._name = name

    def __set_name__(self, owner: type, name: str) -> None:
        self._former = f"{owner.__name__}.{name}"

    def __get__(self, holder: object, owner: type | None = None) -> Any:
        if holder is None:
            return self
        warnings.warn(f"{self._former} is {self._name} now; the old name goes with the next release.", FutureWarning, stacklevel=2)
        return getattr(holder, self._name)


# What is given at public doors: a value of a kind, refused in one form of words. NumPy is loaded by those that ask it, as above.


def is_number(value: object) -> TypeGuard[float]:
    """Return whether a value is one finite real number."""
    if isinstance(value, bool):
        return False
    if not isinstance(value, (int, float)):
        import numpy as np

        if not isinstance(value, (np.integer, np.floating)):
            return False
    try:
        return math.isfinite(value)
    except OverflowError:
        return False


def is_whole(value: object) -> TypeGuard[int]:
    """Return whether a value is one whole number, Python's or NumPy's."""
    if isinstance(value, int):
        return not isinstance(value, bool)
    import numpy as np

    return isinstance(value, np.integer)


def is_listed(given: object) -> TypeGuard[Sequence[Any]]:
    """Return whether a value is a list or a tuple."""
    return isinstance(given, (list, tuple))


def is_class_of(given: object, kind: type[Kind]) -> TypeGuard[type[Kind]]:
    """Return whether a value is a class of a kind."""
    return isinstance(given, type) and issubclass(given, kind)


def instance_of(given: object, kind: type[Kind]) -> Kind | None:
    """Return an object of a kind, of a class of it one that is made; None for anything else."""
    return given if isinstance(given, kind) else given() if is_class_of(given, kind) else None


def can_be_called(given: object) -> TypeGuard[Callable[..., object]]:
    """Return whether a value can be called as a function, which a class is not."""
    return callable(given) and not isinstance(given, type)


def two_of(given: object) -> tuple[Scalar, ...]:
    """Return both parts of a list, a tuple or an array of two, such as the coordinates of a place; nothing for anything else."""
    import numpy as np

    parts = tuple(given) if is_listed(given) or (isinstance(given, np.ndarray) and given.ndim) else ()
    return parts if len(parts) == 2 else ()


VERBS = ("is ", "has ", "stands ", "cannot ", "compares ", "does ")
"""What begins with one of these goes on from the value, as in `scale=0 is no size.`"""


def fits_shape(value: object, shape: tuple[int, ...]) -> bool:
    """Return whether a number or an array can be broadcast to a shape, that of some poses."""
    import numpy as np

    try:
        return np.broadcast_shapes(np.shape(cast(float, value)), shape) == shape
    except ValueError:
        return False


def of_one_shape(what: str, names: Iterable[str], arrays: Sequence[FloatArray]) -> list[FloatArray]:
    """Return named arrays broadcast against each other; DefinitionError, with all shapes, where they do not fit: `the strokes' shapes`."""
    import numpy as np

    try:
        return list(np.broadcast_arrays(*arrays))
    except ValueError:
        shapes = ", ".join(f"{name} {array.shape}" for name, array in zip(names, arrays, strict=True))
        raise DefinitionError(f"{what} do not fit each other: {shapes}.") from None


def unfit(what: str, value: object, expected: str) -> DefinitionError:
    """Return the error for a value: `count=0: a number is expected.`, `scale=0 is no size.`; `gap(width` is closed behind the value."""
    given = f"{what}={cited(value)}{')' * (what.count('(') - what.count(')'))}" if what else cited(value)
    return DefinitionError(f"{given}{' ' if expected.startswith(VERBS) else ': '}{expected}.")


def require(holds: object, what: str, value: object, expected: str) -> None:
    """Refuse a value of which something does not hold; in the words of `require_number`."""
    if not holds:
        raise unfit(what, value, expected)


def require_one_design(designs: Mapping[str, object], said: str) -> None:
    """Refuse a batch by its dimensions: `Crane: a figure shows one design, this is a batch, L has 3 values; choose one of them.`"""
    import numpy as np

    for name, value in designs.items():
        values = np.asarray(value)
        ensure(not values.ndim, f"{said}, this is a batch, {name} has {values.size} values; choose one of them.")


def require_whole(what: str, value: object, expected: str, *, least: float = -math.inf, most: float = math.inf) -> int:
    """Return one whole number from `least` to `most`; refuse anything else, as `require_number` does."""
    if not (is_whole(value) and least <= value <= most):
        raise unfit(what, value, expected)
    return int(value)


def require_type(
    what: str, value: object, kind: type[Kind] | tuple[type[Kind], ...], expected: str, of: type | tuple[type, ...] | None = None
) -> Kind:
    """Return a value of a kind, with its parts `of` a kind where that is given; refuse anything else, as `require_number` does."""
    if not isinstance(value, kind) or (of is not None and not all(isinstance(each, of) for each in cast(Iterable[object], value))):
        raise unfit(what, value, expected)
    return value
