"""Common parts of the papers' machines: their commands' options, duties from `--set`, figures by name, answers over one motion."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Callable, Mapping, Sequence
from dataclasses import fields
from typing import TYPE_CHECKING, TypeVar

from hydraulics.inputs import not_negative, one_number, positive
from linkage import ForceElement, Mechanism, Motion
from linkage.cli.command import CSV, Option, option, picture_option, pose_options
from linkage.cli.settings import CHECK, OVER, machine_of, pair, si_value
from linkage.errors import DefinitionError, known_name, require_one_design
from linkage.motion import Answer, Question, judge_along
from linkage.statics import AnyMotion

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Machine = TypeVar("Machine", bound=Mechanism)
Duty = TypeVar("Duty")


def figure_options(figures: Sequence[str], default: str) -> tuple[Option, ...]:
    """Return the options of a command on one machine that prints its table and its verdicts and draws one of its figures."""
    figure = option("--figure", choices=figures, help=f"which figure (default: {default})")
    return CSV, picture_option("the figure"), figure, *pose_options(11), OVER, CHECK


def machine_like(options: Namespace, base: type[Machine], what: str) -> Machine:
    """Return the machine that the options mean, with their settings; DefinitionError unless it is one of a kind."""
    machine = machine_of(options)
    remedy = f"take a {base.__name__}, a subclass of it, or a file of a design, with `machine` and `[set]`"
    if not isinstance(machine, base):
        raise DefinitionError(f"{options.machine} is no {what}; {remedy}.")
    return machine


def hold_numbers(duty: object, above_zero: Sequence[str], not_below_zero: Sequence[str] = ()) -> None:
    """Hold the numbers of a frozen duty as floats; DefinitionError for one that is none, or not above or below zero as it is said."""
    for each in fields(duty):  # type: ignore[arg-type]
        if isinstance(each.default, float):
            object.__setattr__(duty, each.name, one_number(getattr(duty, each.name), each.name))
    for check, names in ((positive, above_zero), (not_negative, not_below_zero)):
        for name in names:
            check(getattr(duty, name), name)


def duty_set(duty: type[Duty], options: Namespace, example: str, kinds: Mapping[str, str]) -> Duty:
    """Return the duty of `--set`: its numbers with their units, of the kinds by their names, else lengths."""
    names, given = tuple(each.name for each in fields(duty) if isinstance(each.default, float)), dict[str, float]()  # type: ignore[arg-type]
    for text in options.settings:
        name, value = pair(text, "--set", example)
        known_name("Number of the duty", name, names)
        given[name] = si_value(value, kinds.get(name, "length"), f"--set {name}")
    return duty(**given)


def named_figure(figures: Mapping[str, Callable[[Machine], Figure]], name: str, machine: Machine) -> Figure:
    """Return a figure of a machine by its name; DefinitionError for an unknown name, a batch of designs."""
    known_name("Figure", name, figures)
    require_one_design(machine.dimensions, f"{machine.plan.title}: a figure shows one design")
    return figures[name](machine)


def own_loads(motion: AnyMotion, *but: str) -> list[str]:
    """Return the names of all loads that the machine declares, a user's additions too, but those named."""
    return [name for name in motion.plan.of_kind(ForceElement) if name not in but]


def answers_over(motion: Motion, questions: Sequence[Question]) -> list[Answer]:
    """Return the answers to some questions over all that a motion covers."""
    return judge_along(motion).answers(questions)
