"""Errors: every deliberate failure with its fault, its place, and the remedy."""

from __future__ import annotations

import sys
import warnings
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from difflib import get_close_matches
from traceback import extract_tb
from typing import TYPE_CHECKING, Any, TypeVar

if TYPE_CHECKING:
    import numpy.typing as npt

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
        last = extract_tb(error.__traceback__)[-1]
        where = f"{last.filename}, line {last.lineno}"
        raise DefinitionError(f"{what} raises {type(error).__name__}: {error} ({where}); mend it there.") from error


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
        text = " ".join(repr(value).split())
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


def did_you_mean(name: object, names: Sequence[str]) -> str:
    """Return " Did you mean ...?" with the nearest of some names; "" where none is near."""
    near = get_close_matches(name, names, n=1, cutoff=0.5) if isinstance(name, str) else []
    if isinstance(name, str) and not near:  # a word of longer names
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
