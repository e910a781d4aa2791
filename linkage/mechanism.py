"""A mechanism: its class is the structure, an instance its dimensions."""

from __future__ import annotations

import sys
import warnings
from abc import ABCMeta
from collections.abc import Callable, Mapping, Sequence
from copy import copy
from dataclasses import replace
from functools import wraps
from inspect import isfunction
from typing import TYPE_CHECKING, Any, ClassVar, NoReturn, Self, TypeVar, cast

import numpy as np
import numpy.typing as npt

from .assembly import Assembly, assembled, assemblies, width_words
from .errors import (
    DefinitionError,
    cited,
    ensure,
    errors_of,
    is_class_of,
    is_listed,
    is_yes,
    known_name,
    require,
    require_one_design,
    require_type,
    unknown,
)
from .frozen import FrozenDict
from .loads import PLAIN_CASE, Acting, ForceElement, LoadCase, check_together
from .loads.element import Formulas
from .mobility import FourBar, Mobility, chain_graph, check, four_bars, mobility
from .motion import Answer, Featured, Positions, RequestLike, Target, at_values, follow_path, from_above, positions_for, sweep_values
from .motion.functions import PoseFunction, evaluate, source_of
from .motion.judge import Judge, Question, case_named
from .motion.motion import Motion, require_motion
from .motion.motion_verdicts import HELD, judge_verdicts, refused_forces
from .motion.over import OPTIONS, Over
from .motion.table import Column, columns_of
from .plan import Body, Part, Plan, check_circuits, require_kinds, with_parts
from .program import QUICKEST, BackendName, FloatArray, Language, RunOptions
from .quantities import Member, Stroke, is_name, keywords, needs
from .shown import Shown, ShownList
from .steps import Drawn
from .vectors import Numbers
from .verdict import Remark, Verdict

if TYPE_CHECKING:
    import networkx as nx

Method = TypeVar("Method", bound=Callable[..., object])
Result = TypeVar("Result")


def of_a_design(method: Method) -> Method:
    """Return a method of a design that refuses in words to be called on the class, which is the structure, without a design."""

    @wraps(method)
    def checked(*given: object, **options: object) -> object:
        if not (given and isinstance(type(given[0]), MechanismType)):
            name = method.__name__
            said = f"{name}(...) is asked of a design, and this is the class, which is the structure; make one first"
            raise DefinitionError(f"{said}, FourBar().{name}(...) for a class FourBar.")
        return method(*given, **options)

    return cast(Method, checked)


def of_own_motion(method: Callable[[Mechanism, Motion], Result]) -> Callable[[Mechanism, Motion], Result]:
    """Return a machine's own `columns` or `rules`, which refuses in words anything but a motion of the machine."""

    @wraps(method)
    def checked(machine: Mechanism, motion: Motion) -> Result:
        check_motion(machine, motion, method.__name__)
        with errors_of(f"{machine.plan.title}.{method.__name__}(motion)"):
            return method(machine, motion)

    return checked


def played_along(motion: Motion, at: object) -> tuple[Mechanism, Motion]:
    """Return the design of a motion, and the motion that it is shown along.

    DefinitionError where `at` says another way, or the class of the motion is not there any more.
    """
    ensure(not at, f"{motion.plan.title}: a motion has its own way; at={cited(at)} goes with a machine.")
    classes: list[type[Mechanism]] = [Mechanism]
    for each in classes:
        if each.plan is motion.plan:
            return each(**motion.designs), motion
        classes += each.__subclasses__()
    raise DefinitionError(f"{motion.plan.title}: the class of this motion is not there any more; give its machine.")


def verdicts_of(machine: Mechanism, judge: Judge, motion: Motion | None = None) -> list[Verdict]:
    """Return the verdicts of a judge and of the machine's rules; asked again in other words or units, the judge searches nothing."""
    fault: Verdict | None = from_above(HELD)(judge)
    fault = refused_forces(judge) if fault is None else fault
    try:
        own: object = machine.rules(judge.places[0].sampled if motion is None else motion)
    except DefinitionError:
        if fault is None:
            raise
        own = []
    if not is_listed(own) or not all(isinstance(each, str) for each in own):
        raise DefinitionError(f"{machine.plan.title}: rules(motion) gives {cited(own)}; a list of Verdicts and sentences is expected.")
    general = judge_verdicts(judge) if fault is None else [fault, *judge_verdicts(judge, fault.sentence)]
    return ShownList([*general, *(each if isinstance(each, Verdict) else Remark(each) for each in own)])


def check_motion(machine: Mechanism, motion: object, what: str) -> None:
    """Raise DefinitionError for anything but a motion of a machine that has the members of this one."""
    found = require_motion(motion)
    missing = [name for name in machine.plan.members if name not in found.plan.members]
    if missing:
        said = f"{what}(...) is given a motion of {found.plan.title}, which has no {missing[0]}"
        raise DefinitionError(f"{machine.plan.title}: {said}; give one of {machine.plan.title}.")


class ClassBody(dict[str, object]):
    """The body of a class while it is read: a name with a member takes no other one, which would lose the first."""

    def __init__(self, title: str) -> None:
        super().__init__()
        self.title = title

    def __setitem__(self, name: str, value: object) -> None:
        first = self.get(name)
        if isinstance(first, Member) and value is not first:
            for each, member in self.items():  # so that the message names the others and does not spell them out
                if each != name and isinstance(member, Member):
                    member.__set_name__(Mechanism, each)
            both = f"{name} = {as_line(first)} stands there already, and {name} = {as_line(value)} would take its place without a word"
            raise DefinitionError(f"{self.title}: {both}; give one of them another name, or take one out.", member=name)
        if isinstance(value, Part) and not value.name:
            object.__setattr__(value, "_name", name)  # so that the next lines can say lower.B
        super().__setitem__(name, value)


def as_line(value: object) -> str:
    """Return a line's right side for a message; its kind alone where its parts have no names yet."""
    try:
        return str(value) if isinstance(value, Member) else cited(value)
    except DefinitionError:
        return f"{type(value).__name__}(...)"


class MechanismType(ABCMeta):
    """The class of the classes of mechanism: a class does not change once it is made."""

    plan: Plan

    @classmethod
    def __prepare__(cls, name: str, bases: tuple[type, ...], /, **options: object) -> ClassBody:
        return ClassBody(name)

    def __setattr__(cls, name: str, value: object) -> None:
        builder = str(sys._getframe(1).f_globals.get("__name__", ""))
        by_value = builder.startswith("cloudpickle")  # which makes a class of another process empty, then gives it what it has
        if not by_value:
            cls._check_made(name, "= ...", isinstance(value, Member))
        super().__setattr__(name, value)

    def __delattr__(cls, name: str) -> None:
        cls._check_made(name, "is deleted")
        super().__delattr__(name)

    def _check_made(cls, name: str, what: str, is_member: bool = False) -> None:
        """Raise DefinitionError for a change of the class once it is made."""
        if is_member or name == "plan" or isinstance(getattr(cls, name, None), Member) or name in cls.plan.members:
            remedy = f"write a subclass, class Other({cls.__name__}): {name} = ..."
            raise DefinitionError(f"{cls.__name__}.{name} {what}: {cls.__name__} is worked out already and would not follow; {remedy}.")


class Mechanism(Shown, metaclass=MechanismType):
    """The base of every mechanism. A subclass declares points, links and strokes, one line each, in any order.

    An instance is a design: `ThreePointHitch(OB=0.32)`. A subclass of a mechanism is a variant: it replaces members by name and adds
    others.

    Parameters
    ----------
    **dimensions : float or array
        Dimensions by name [SI]: numbers, or arrays with one value for each design. The others are as the class has them.

    Raises
    ------
    DefinitionError
        A name is no dimension, a value is not finite or cannot be, or arrays do not broadcast.
    """

    plan: ClassVar[Plan] = Plan({}, "Mechanism")
    about: ClassVar[Featured] = Featured()
    """What pictures show where nothing else is asked for; a machine says its own, `about = Featured("tilt", ["G"])`."""

    def __init_subclass__(cls, **options: object) -> None:
        super().__init_subclass__(**options)
        if "verdicts" in vars(cls):
            remedy = "name it rules(self, motion): what it returns is added to these, and super().rules(motion) gives those of its base"
            raise DefinitionError(f"{cls.__name__}.verdicts replaces what is said of every machine; {remedy}.", member="verdicts")
        check_bindable(cls.__name__, "class")
        for name in ("columns", "rules"):
            if isfunction(vars(cls).get(name)):
                type.__setattr__(cls, name, of_a_design(of_own_motion(vars(cls)[name])))
        members = declared(cls)
        with_members = with_parts(members, cls.__name__)
        type.__setattr__(cls, "plan", Plan(assembled(with_members, cls.__name__), cls.__name__))
        if PLAIN_CASE in cls.plan.of_kind(LoadCase):
            text = f"{cls.__name__}: a load case cannot be named {PLAIN_CASE}: that is what the machine's own loads are called; rename it."
            raise DefinitionError(text, member=PLAIN_CASE)
        reached = cls.plan.reaches(*cls.plan.moving)
        for name in cls.plan.strokes:
            if name in OPTIONS:
                text = f"{cls.__name__}: a stroke cannot be named {name}, which Over takes for something else; rename it."
                raise DefinitionError(text, member=name)
            if name not in reached and cls.plan.points:
                raise idle_stroke(cls.plan, name)
        for name, sketch in cls.plan.of_kind(Drawn).items():
            try:
                at_values(cls.plan.sketch_strokes, cls.plan)
            except DefinitionError as error:
                raise DefinitionError(f"{cls.__name__}: {name} = {sketch}: {error}", member=name) from None
        check(cls.plan)
        for element in cls.plan.of_kind(ForceElement).values():
            require_kinds(cls.plan, element.stroke_arguments([*cls.plan.strokes]))
        if cls.plan.of_kind(Part):
            check_circuits(cls.plan.members, cls.__name__)
        check_together(cls.plan.of_kind(ForceElement), cls.plan.members, cls.__name__)
        for member in (*members.values(), *cls.plan.members.values()):
            member.settle(cls.__name__)

    @classmethod
    def _owner(cls, name: str) -> type[Mechanism]:
        """Return the class that gives a machine its `columns` or its `verdicts`: itself or the nearest of its bases that has them."""
        return next(base for base in cls.__mro__ if name in vars(base) and issubclass(base, Mechanism))

    def __init__(self, **dimensions: npt.ArrayLike) -> None:
        self._values = FrozenDict(self._settings(dimensions))

    def _settings(self, dimensions: Mapping[str, npt.ArrayLike]) -> dict[str, Numbers]:
        """Return the values of all dimensions, some of them set; DefinitionError for a wrong name or value."""
        for name in dimensions:
            if name in self.plan.strokes:
                error = unknown("Dimension", name, self.plan.table.names(), where=self.plan.title)
                said = keywords({name: "..."})
                raise DefinitionError(f"{error} {name} is a stroke; give it to sweep({said}) or at({said}).")
        require_kinds(self.plan, dimensions)
        return self.plan.table.settings(dimensions)

    def __getattr__(self, name: str) -> Any:
        """Raise AttributeError with a suggestion: a dimension is read by `machine["OB"]`."""
        title = type(self).__name__
        ensure(name != "_values", f"{title}: its own __init__ does not call super().__init__(**dimensions); let it do that first.")
        remedy = f'; the dimension is machine["{name}"]' if not name.startswith("_") and name in self else ""
        raise AttributeError(f"{title} has no attribute {name!r}{remedy}.", name=name, obj=self)

    def __contains__(self, name: object) -> bool:
        """Whether a name is that of a dimension: `"OB" in machine`."""
        return isinstance(name, str) and (name in self.plan.table.spellings or f"{name}.x" in self.plan.table.spellings)

    def __iter__(self) -> NoReturn:
        """Raise DefinitionError: a design is no row of things."""
        raise DefinitionError(f"{type(self).__name__}: a design is gone through by its dimensions; take machine.dimensions.")

    def __class_getitem__(cls, name: object) -> NoReturn:
        """Raise DefinitionError: a class has members, its designs have values."""
        raise DefinitionError(f"{cls.__name__}[{name!r}]: {cls.__name__} is a class; ask a design of it, {cls.__name__}()[{name!r}].")

    def __setattr__(self, name: str, value: object) -> None:
        if not name.startswith("_"):
            new = f"{type(self).__name__}({name}=...)"
            raise DefinitionError(f"{type(self).__name__}.{name} = ...: an instance does not change; make a new one, {new}.")
        super().__setattr__(name, value)

    @property
    def dimensions(self) -> Mapping[str, Any]:
        """Every design variable with its value [SI]."""
        return dict(self._values)

    def __getitem__(self, name: str) -> Any:
        """Return a design variable's value [SI]; a fixed point's position, shape (2, ...)."""
        if not isinstance(name, str):
            raise unknown("Dimension", name, self.plan.table.names(), where=self.plan.title)
        if {f"{name}.x", f"{name}.y"} <= self._values.keys():
            return np.array(np.broadcast_arrays(self._values[f"{name}.x"], self._values[f"{name}.y"]))
        owner, sign = self.plan.table.spellings.get(name, ("", 1))
        if not owner:
            self.plan.table.settings({name: 0.0})
        return sign * self._values[owner]

    def replaced(self, **dimensions: npt.ArrayLike) -> Self:
        """Return the same design with some dimensions changed.

        Parameters
        ----------
        **dimensions : float or array_like
            New values by name [SI]; arrays make a batch.

        Returns
        -------
        Mechanism
            The new design.

        Raises
        ------
        DefinitionError
            An unknown name, or a value out of range.
        """
        given, spellings = self._settings(dimensions), self.plan.table.spellings
        named = {each for name in dimensions for each in (name, f"{name}.x", f"{name}.y")}
        touched = {spellings[each][0] for each in named if each in spellings}
        changed = copy(self)
        changed._values = FrozenDict({name: given[name] if name in touched else value for name, value in self._values.items()})
        return changed

    def _part(self, start: int, stop: int) -> Self:
        """Return the designs from start to before stop of a batch, whose dimensions are floats or arrays (m,)."""
        part = copy(self)
        values = self._values.items()
        part._values = FrozenDict({name: value if isinstance(value, float) else value[start:stop] for name, value in values})
        return part

    def sweep(self, count: int | None = None, /, *, over: object = None, unreachable: str = "raise", **strokes: object) -> Motion:
        """Return the motion over the whole stroke, at `count` poses.

        With several strokes each is named: `sweep(S1=101, S2=0.15)`, an int is a count, a float a value; two
        counts give a grid. `over` is an `Over` or the name of a declared one, `sweep(401, over="digging")`: the motion runs along its path
        at equal shares of the way, and keeps it, so that it is judged where it was declared. Raises AssemblyError where it cannot be
        assembled, unless `unreachable="nan"`.

        Of one design along one stroke the whole way is looked at, however few the poses: AssemblyError for a stretch between two poses that
        cannot be assembled, SingularError for a change point. A stretch narrower than 1e-6 of the stroke may be reported as a change point,
        a clearance of less than 1e-12 of the links as none. What lies within 1e-7 of the stroke next to its ends is not passed. With
        `unreachable="nan"`, `motion.interruptions` lists them. Batches and several strokes are not searched in this way.

        Parameters
        ----------
        count : int, optional
            The number of poses of the only stroke, or along `over`.
        over : Over or str, optional
            The domain, or the name of a declared one.
        unreachable : str
            "raise" refuses poses out of reach, "nan" leaves them out.
        **strokes : int or float
            A number of poses, or a value [m or rad], by the stroke's name.

        Returns
        -------
        Motion
            The motion.

        Raises
        ------
        AssemblyError
            The machine cannot be assembled at some pose.
        SingularError
            A change point lies on the way.
        """
        if over is not None:
            ensure(not strokes, f"{self.plan.title}: sweep(over=...) says where all strokes are; leave out {keywords(strokes)}.")
            require(not is_listed(over), f"{self.plan.title}: over", over, "a motion runs over one Over; give that one")
            return self.judge((over,)).places[0].swept(count, unreachable)
        return Motion(self.plan, self._values, sweep_values(count, strokes, self.plan), unreachable)

    def at(self, *unnamed: object, unreachable: str = "raise", per_design: object = False, **strokes: object) -> Motion:
        """Return the motion at chosen strokes [SI]: `at(S=[0.0, 0.1])`. They may lie beyond the declared range.

        Strokes are shared by all designs of a batch; with `per_design` each design has its own: their arrays then begin with the shape of
        the designs, (*designs, *strokes), as results do. The way from the least to the greatest of several is looked at as that of a sweep.
        DefinitionError for a value without its stroke.

        Parameters
        ----------
        *unnamed : object
            Refused, with the name of the stroke.
        unreachable : str
            "raise" refuses poses out of reach, "nan" leaves them out.
        per_design : bool
            Whether each design has strokes of its own.
        **strokes : float or array_like
            Values of the strokes by name [m or rad].

        Returns
        -------
        Motion
            The motion.

        Raises
        ------
        AssemblyError
            The machine cannot be assembled at some pose.
        DefinitionError
            A value without its stroke.
        """
        if unnamed:
            text = f"{self.plan.title}: at({cited(unnamed[0])}) does not say which stroke has this value"
            ways = " or ".join(f"at({keywords({name: '...'})})" for name in self.plan.strokes)
            raise DefinitionError(f"{text}; write {ways or 'at()'}.")
        return Motion(self.plan, self._values, at_values(strokes, self.plan), unreachable, per_design=is_yes("per_design", per_design))

    def follow(
        self,
        targets: Sequence[Target],
        *,
        hold: Mapping[str, float] | None = None,
        start: Mapping[str, float] | None = None,
        unreachable: str = "raise",
    ) -> Motion:
        """Return the motion along a path of places, on one branch: `follow([Target(x("M"), 2.5), Target(y("M"), heights)])`.

        As many `Target`s as strokes, less those on `hold`, a number each [SI]. Their values are arrays, one value a place, or numbers that
        hold at all of them; angles count modulo a turn. Between places it goes straight from value to value. `start` are strokes near
        those of the first place; without it the branches of that place are tried, the nearest to the declared first pose first, and the
        first one that goes all the way is taken. Where none does it raises AssemblyError, of a stroke past its end, or SingularError, of
        a dead point, for the one that goes farthest: with the place, the stroke, the millimetres; unless `unreachable="nan"`.

        Parameters
        ----------
        targets : sequence of Target
            The targets, as many as strokes that are free.
        hold : mapping, optional
            Strokes held at a value by name [m or rad].
        start : mapping, optional
            Strokes near those of the first place [m or rad].
        unreachable : str
            "raise" refuses poses out of reach, "nan" leaves them out.

        Returns
        -------
        Motion
            The motion along the places.

        Raises
        ------
        AssemblyError
            A stroke ends on the way.
        SingularError
            A dead point lies on the way.
        """
        return follow_path(self.plan, self._values, targets, hold, start, unreachable)

    def evaluate(
        self,
        of: Sequence[RequestLike],
        *,
        out: FloatArray | None = None,
        unreachable: str = "raise",
        backend: BackendName | None = None,
        threads: int = 1,
        per_design: object = False,
        rates: Mapping[str, object] | None = None,
        accelerations: Mapping[str, object] | None = None,
        **strokes: object,
    ) -> list[FloatArray]:
        """Return values, ratios and forces of many poses in one pass, nothing else: `G, T = evaluate(["G", thrust()], S=...)`.

        One array a request, shape (2, *designs, *strokes) of a point, (*designs, *strokes) of a quantity. Designs share the strokes, or
        have their own `per_design`, as in `at`. `out`, shape (components, *designs, *strokes), takes the results; the arrays returned are
        its rows. `backend` is "numpy", "numba" or "floats", or a class of your own that runs a schedule; without it the quickest for the
        work, on one thread. `rates` [1/s] and `accelerations` [1/s2] say by name how strokes move, for dampers and inertia. They are
        numbers or arrays that fit the strokes. Poses are taken one by one: unlike `at` it does not look for
        change points between them. Raises AssemblyError out of reach and SingularError for ratios at a dead point, unless
        `unreachable="nan"`.

        Parameters
        ----------
        of : sequence of str, Quantity or Request
            The values asked for.
        out : ndarray, optional
            Takes the results, shape (components, *designs, *strokes).
        unreachable : str
            "raise" refuses poses out of reach, "nan" leaves them out.
        backend : str, optional
            "numpy", "numba" or "floats"; by default the quickest.
        threads : int
            The number of threads.
        per_design : bool
            Whether each design has strokes of its own.
        rates : mapping, optional
            Rates of the strokes by name [1/s], for dampers and inertia.
        accelerations : mapping, optional
            Accelerations of the strokes by name [1/s2], for inertia.
        **strokes : float or array_like
            Values of the strokes by name [m or rad].

        Returns
        -------
        list of ndarray
            One array a request: shape (2, *designs, *strokes) of a point, (*designs, *strokes) of a quantity.

        Raises
        ------
        AssemblyError
            A pose is out of reach.
        SingularError
            A ratio is asked for at a dead point.
        """
        is_quickest = backend is None and type(threads) is int and threads == 1
        options, own = QUICKEST if is_quickest else RunOptions(backend, threads), is_yes("per_design", per_design)
        return evaluate(self.plan, self._values, strokes, of, out, options, unreachable, own, rates, accelerations)

    def function(self, of: Sequence[RequestLike], *, rates: bool = False, accelerations: bool = False) -> PoseFunction:
        """Return values, ratios and forces of this design as a function of the strokes, in floats: `f = function(["G", ratio("G")])`.

        `f(0.1)` returns all components one after the other, here (G_x, G_y, dG_x, dG_y), in some microseconds: for root
        finders and other loops that take one pose at a time. It raises what `evaluate` raises. With `rates` the
        rates of all strokes [1/s] follow these, with `accelerations` then their accelerations [1/s2]: `f(0.1, 0.05, 0.5)`.

        Parameters
        ----------
        of : sequence of str, Quantity or Request
            The values asked for.
        rates : bool
            Whether the function takes the rates of the strokes [1/s].
        accelerations : bool
            Whether it takes their accelerations [1/s2].

        Returns
        -------
        callable
            The function of floats; it returns a tuple of all components.
        """
        return PoseFunction(self.plan, self._values, of, time_orders(rates, accelerations))

    def source(
        self, of: Sequence[RequestLike], *, language: str | Language = "c", name: str = "poses", rates: bool = False,
        accelerations: bool = False,
    ) -> str:  # fmt: skip
        """Return values and ratios as the text of a function in "c" or "javascript", for a controller or a page of one's own.

        `language` may be a `linkage.program.Language` of your own.
        Dimensions and strokes are its arguments, in the order that its first comment gives, SI and radians; NaN out of reach. Pins
        that are found by iteration have no closed form and are refused by name. With `rates` and `accelerations` those of the strokes are
        arguments too, where what is asked for follows them.

        Parameters
        ----------
        of : sequence of str, Quantity or Request
            The values asked for.
        language : str or Language
            "c", "javascript", or a language of your own.
        name : str
            The name of the function.
        rates : bool
            Whether the function takes the rates of the strokes [1/s].
        accelerations : bool
            Whether it takes their accelerations [1/s2].

        Returns
        -------
        str
            The source text.

        Raises
        ------
        DefinitionError
            A value without a closed form.
        """
        return source_of(self.plan, self._values, of, language, name, time_orders(rates, accelerations))

    def columns(self, motion: Motion) -> list[Column]:
        """Return the table of results: strokes, moving points, named outputs. A machine replaces it by its own.

        Parameters
        ----------
        motion : Motion
            The poses; designs first, strokes last.

        Returns
        -------
        list of Column
            The columns, one number a pose.
        """
        return columns_of(motion)

    def verdicts(self, motion: Motion | None = None, *, over: object = None, acting: Acting | None = None) -> list[Verdict]:
        """Return the verdicts on this design, as `Verdict`s and `Remark`s; of a batch, how many designs fail.

        Of a motion over all that it covers, without one over `overs` or what is given as `over`; under all load cases that occur, in all
        movements, on both sides of cylinders. The first is `held` where the machine is not: there are no forces then. Then come whether it
        is assembled, its dead points, what its members say, such as cylinders and circuits, and its own `rules`.

        Parameters
        ----------
        motion : Motion, optional
            The motion that is judged.
        over : Over, str or mapping, optional
            The domain, or the name of a declared one; by default all that the machine runs.
        acting : Acting, optional
            Loads, load case, direction and rates in one.

        Returns
        -------
        list of Verdict
            The verdicts and remarks.
        """
        if motion is not None and over is not None:
            raise DefinitionError(f"{self.plan.title}.verdicts: a motion and over= both say where is looked; give one of them.")
        if motion is not None:
            check_motion(self, motion, "verdicts")
        return verdicts_of(self, self.judge(over if motion is None else motion, acting), motion)

    def rules(self, motion: Motion) -> Sequence[str]:
        """Return this machine's own verdicts on a motion, in addition to the general ones: `Verdict`s; a plain sentence is a `Remark`.

        Parameters
        ----------
        motion : Motion
            The poses; designs first, strokes last.

        Returns
        -------
        sequence of Verdict or str
            The verdicts and remarks.
        """
        return []

    @property
    def overs(self) -> tuple[Over, ...]:
        """The domains of this machine: the `Over`s that its class declares, else the box of all strokes."""
        return tuple(self.plan.of_kind(Over).values()) or (Over(),)

    def answers(
        self, questions: Sequence[Question], over: Over | Mapping[str, object] | Sequence[Over] | None = None, acting: Acting | None = None
    ) -> list[Answer]:
        """Return the answers to questions, the worst over everything that is looked at: one function for every reader.

        `answers([least(reserve("lift")) >= 1, most(pin_force("V")), reachable])`: a question is a measure, a condition such as `fits(lift)`
        or a comparison of measures. `over` is one `Over` or several, a dictionary short for one, default `overs`. `acting` says loads,
        a load case, a direction; without it all load cases count that occur, all directions, both sides of every cylinder.

        Parameters
        ----------
        questions : sequence of Measure or Condition
            The questions.
        over : Over, str or mapping, optional
            The domain, or the name of a declared one; by default all that the machine runs.
        acting : Acting, optional
            Loads, load case, direction and rates in one.

        Returns
        -------
        list of Answer
            The answers in the same order.
        """
        judge = self.judge(over, acting)
        wide = width_words(self.plan, judge.designs)
        if wide:
            warnings.warn(f"{self.plan.title}: {wide}", stacklevel=3)
        return ShownList(judge.answers(questions))

    def judge(self, over: object = None, acting: Acting | None = None) -> Judge:
        """Return the judge who answers questions of this design, over given domains or its own.

        Parameters
        ----------
        over : Over, str or mapping, optional
            The domain, or the name of a declared one; by default all that the machine runs, of a load case where that occurs.
        acting : Acting, optional
            Loads, load case, direction and rates in one.

        Returns
        -------
        Judge
            The judge.
        """
        declared = {each.name: each for each in self.overs if each.name}
        overs: list[Over | Motion] = []
        case = getattr(acting, "case", None)
        name = case_named(self.plan, case) if isinstance(case, str) else getattr(case, "name", case)
        occurring = [each for each in self.overs if name is None or each.cases is None or name in each.cases]
        given: Sequence[object] = (occurring or self.overs) if over is None else over if is_listed(over) else (over,)
        for each in given or (over,):
            if isinstance(each, str):
                overs.append(declared[known_name("Over", each, declared, where=self.plan.title)])
            elif isinstance(each, (Over, Motion)):
                overs.append(each)
            elif isinstance(each, Mapping) and all(isinstance(name, str) for name in each):  # short for an Over
                overs.append(Over(**each))
            else:
                what = "an Over is expected, such as Over(S=(0.0, 0.2)), or several"
                raise DefinitionError(f"{self.plan.title}: over={cited(each)}: {what}.")
        return Judge(self.plan, self._values, overs, acting, self)

    def featured(self) -> Featured:
        """Return the features that pictures of this design show by default: `about`, unless a machine defines more here.

        Returns
        -------
        Featured
            The column, the points and the limits.
        """
        return self.about

    def formulas(self, written: Formulas) -> None:
        """Write the equations of forces beyond the driving forces: those of its elements. A machine replaces them by its own.

        Parameters
        ----------
        written : Formulas
            The sheet of equations.
        """
        for element in self.plan.of_kind(ForceElement).values():
            if not element.feeds(self.plan.members):
                element.formulas(written)

    @property
    def strokes(self) -> Mapping[str, Stroke]:
        """The strokes by name."""
        return dict(self.plan.strokes)

    def assemblies(self, **strokes: float) -> list[Assembly]:
        """Return all assembly modes that exist at a stroke, `assemblies(S=0.1)`; default the start of each. `draw` shows them.

        Each holds the sides of its dyads, its places and the `code` that chooses it, the lines of the class that are different. One
        design at a time. Groups are solved from many places at random, which may miss a mode. DefinitionError for more than 16 dyads.

        Parameters
        ----------
        **strokes : float
            A stroke's value by name [m or rad].

        Returns
        -------
        list of Assembly
            The modes.

        Raises
        ------
        DefinitionError
            More than 16 dyads.
        """
        pose = self.at(unreachable="nan", **{name: stroke.start for name, stroke in self.strokes.items()} | strokes)
        ensure(not pose.shape, f"{self.plan.title}: assembly modes are listed for one design at one pose.")
        return ShownList(assemblies(self.plan, pose.inputs, with_parts(declared(type(self)), self.plan.title)))

    @property
    def four_bars(self) -> list[FourBar]:
        """The four-bars on the frame, each with its Grashof class."""
        require_one_design(self._values, f"{self.plan.title}: four-bars are classed for one design")
        return four_bars(self.plan, self.at(unreachable="nan", **self.plan.sketch_strokes).inputs)

    @property
    def links(self) -> tuple[Body, ...]:
        """The bodies by their points, the frame first; those of a cylinder together, which `graph` has one by one."""
        return self.plan.bodies

    @property
    def mobility(self) -> int:
        """The number of independent motions, by the rank of the constraints; it equals the number of strokes."""
        return mobility(self.plan).rank

    @property
    def freedom(self) -> Mobility:
        """The mobility by rank and by count, with redundant links and the bodies that are loose while the drives are locked, in words."""
        found = mobility(self.plan)
        return found if found.dead else replace(found, loose=from_above(LOOSE)(self.plan).bodies)

    @property
    def gruebler(self) -> int:
        """The Gruebler count 3 (n - 1) - 2 j."""
        return self.plan.gruebler

    @property
    def graph(self) -> nx.MultiGraph:
        """The bodies as nodes and the pins and slides between them as edges, a `networkx.MultiGraph`; `draw` makes its picture.

        The frame is "frame". A pin of n bodies is n - 1 edges, a cylinder is a barrel and a rod, a point on a guide a block.
        3 (n - 1) - 2 j, less one for each rope of a length, is `gruebler`. Nodes have `kind`, `points`, `link` and `dimensions` [m] of this
        design, edges, keyed by name, `kind`, the `strokes` that drive them and `dimensions`, the driven lengths as they are written.
        """
        return chain_graph(self.plan, self.at(unreachable="nan", **self.plan.sketch_strokes).inputs)

    def __repr__(self) -> str:
        changed = {name: value for name, value in self._values.items() if np.ndim(value) or value != self.plan.table.entries[name].default}
        return f"{type(self).__name__}({keywords({name: repr(value) for name, value in changed.items()})})"


for _name, _method in [*vars(Mechanism).items()]:
    if isfunction(_method) and not _name.startswith("_"):
        type.__setattr__(Mechanism, _name, of_a_design(_method))


def strokes_for(machine: Mechanism, targets: Sequence[Target], *, hold: Mapping[str, float] | None = None) -> Positions:
    """Return the strokes of a place: `strokes_for(digger, [Target(x("M"), 2.5), Target(y("M"), 0.3)], hold={"bucket": 1.1})`.

    A place is a list of `Target`s, as many as the machine has strokes, less those on `hold`, a number each [SI]: coordinates of points,
    angles, which count modulo a turn, or any other quantity or request. All branches within the ends of the strokes are returned, each
    with its condition; where there is none, the nearest pose, and which stroke would be past which end, by how much. It warns,
    SingularWarning, where a place is at the border of what the strokes reach. Of infinitely many strokes that give the targets it returns
    some.

    Parameters
    ----------
    machine : Mechanism
        The design.
    targets : sequence of Target
        The targets, as many as strokes that are free.
    hold : mapping, optional
        Strokes held at a value by name [m or rad].

    Returns
    -------
    Positions
        All branches within the ends of the strokes, each with its condition.
    """
    require_mechanism(machine)
    return positions_for(machine.plan, machine.dimensions, targets, hold)


LOOSE = "linkage.statics:looseness"
"""What says which bodies are loose while the drives are locked: in the room of forces, which stands above."""
WORDS = frozenset({"plan", "graph"})
"""Words of the framework that no member may have for its name, beside those of Mechanism itself."""


def declared(cls: type) -> dict[str, Member]:
    """Return the members of a class and its bases by name; a subclass replaces by name."""
    members: dict[str, Member] = {}
    for base in reversed(cls.__mro__):
        for name, value in vars(base).items():
            if isinstance(value, Member):
                check_bindable(name, f"member of {cls.__name__}")
                if name in vars(Mechanism) or name in WORDS:
                    raise DefinitionError(f"{cls.__name__}: {name} is a word of the framework; give the member another name.", member=name)
                members[name] = value
            else:
                check_no_member(cls.__name__, name, value)
                members.pop(name, None)
    return members


def idle_stroke(plan: Plan, stroke: str) -> DefinitionError:
    """Return the error for a stroke that no point follows: its followers, and how a point can follow it."""
    following = {name: member for name, member in plan.members.items() if name != stroke and stroke in plan.reaches(name)}
    text = f"{plan.title}: the stroke {stroke} moves nothing"
    if not following:
        return DefinitionError(f"{text}; use it in a length or an angle, or take it out.", member=stroke)
    name = min(following, key=lambda each: following[each].kind == "quantity")  # of a link and an output the link
    opening = f"{text}: {name} = {following[name]} follows it"
    steps = [each for each in needs(following[name]) if each in plan.points and not plan.points[each].is_fixed]
    if not steps:
        return DefinitionError(f"{opening}, and no point does; use it in the length or the angle of a step.", member=stroke)
    point = steps[-1]
    step = f"{point} = {plan.points[point]}"
    pin = f"{point} = Pin(near=(x, y))"
    remedy = f"Let that step have a length or an angle that follows {stroke}, or write {pin} and what holds it as links"
    return DefinitionError(f"{opening}, but {step} places {point} without it. {remedy}.", member=stroke)


def time_orders(rates: object, accelerations: object) -> int:
    """Return how many orders of derivatives by time are arguments of a function: 1 with rates, 2 with accelerations too."""
    wanted = is_yes("rates", rates), is_yes("accelerations", accelerations)
    ensure(wanted != (False, True), "accelerations=True: they say how rates change; ask for rates=True as well.")
    return sum(wanted)


def check_bindable(name: str, what: str) -> None:
    """Raise DefinitionError for the name of a class or a member that no line of Python could give it, as type(...) takes any text."""
    require(is_name(name), "", name, f"is no name for a {what}: letters, digits and _, no digit first, no word of Python")


def check_no_member(title: str, name: str, value: object) -> None:
    """Raise DefinitionError for a member written by mistake as none: its class, members in a list, or a comma too many."""
    if is_class_of(value, Member):
        raise DefinitionError(f"{title}.{name} = {value.__name__} is the class, no member; write {name} = {value.__name__}(...).")
    machine = value if isinstance(value, type) else type(value)
    if issubclass(machine, Mechanism) and name != getattr(value, "__name__", ""):
        is_class = f"{machine.__name__} is a class of mechanisms and no member"
        what = is_class if machine is value else f"{machine.__name__}(...) is a design, which stays numbers"
        remedy = f"as a part of the machine it is {name} = Part({machine.__name__})"
        raise DefinitionError(f"{title}.{name} = {what}; {remedy}.", member=name)
    parts = value.values() if isinstance(value, dict) else value if isinstance(value, (list, tuple, set, frozenset)) else ()
    lost = [each for each in parts if isinstance(each, Member) and not each.name]
    what = f"{title}.{name} holds {len(lost)} member{'s' if len(lost) > 1 else ''} in a {type(value).__name__}, which declares nothing"
    ensure(not lost, f"{what}; bind each to a name of its own, and look for a comma too many at the end of the line.")


def require_mechanism(given: object) -> Mechanism:
    """Return a design of a mechanism; DefinitionError for anything else."""
    if is_class_of(given, Mechanism):
        raise DefinitionError(f"{given.__name__} is a class, the structure; give a design of it, {given.__name__}().")
    return require_type("", given, Mechanism, "is no mechanism; give a design such as FourBar()")
