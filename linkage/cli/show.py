"""`hydrolinkage show NAME`: a machine's description, its dimensions, its construction, and its verdicts."""

from __future__ import annotations

import re
import sys
from argparse import Namespace
from collections.abc import Iterable, Mapping
from inspect import cleandoc
from pathlib import Path
from typing import TYPE_CHECKING

from ..errors import ensure
from ..mechanism import Mechanism
from ..plan import spanning_name, strokes_text, written_out
from ..quantities import Dimension
from ..reports import design_rows, stroke_rows
from ..reports.values import with_units
from ..shown import text_columns
from .command import Command, group, machine_options, option, picture, picture_option, repeatable, whole_number
from .listing import wrapped
from .settings import CHECK, OVER, judged_code, machine_of, overs_of, strokes_given

if TYPE_CHECKING:
    from ..formulas import Equations


@Command(
    "show",
    "a machine's dimensions, strokes, bodies, construction steps and verdicts",
    *machine_options(),
    OVER,
    CHECK,
    group(
        "equations",
        option("--equations", action="store_true", help="the vector equations too, numbered"),
        option("--start", metavar="N", type=whole_number, help="the first equation's number (default 1)"),
        option("--ratio", metavar="G", action="append", help="the derivatives of a point or an output too; repeatable"),
        option("--wrt", metavar="S", help="the stroke of these derivatives, where there are several"),
        option("--forces", action="store_true", help="the loads, the driving forces, what cylinders and circuits have"),
        option("--numbers", action="store_true", help="with the numbers filled in, at the start of each stroke"),
        repeatable("--at", "S=0.6", "numbers at this stroke; repeatable", "strokes"),
        option("--latex", action="store_true", help="as LaTeX, and nothing else"),
    ),
    group(
        "assembly modes",
        option("--modes", action="store_true", help="all assembly modes with the lines that choose them, and nothing else"),
        picture_option("the modes, drawn; with --modes"),
    ),
)
def show_command(options: Namespace) -> int:
    """Print a machine in sections."""
    check_asked(options)
    machine = machine_of(options)
    over, given = overs_of(machine, options.over), strokes_given(machine, options)
    is_one = all(len(values) == 1 for values in given.values())
    ensure(is_one, f"--at {', '.join(options.strokes)}: numbers are filled in at one pose; give one value.")
    at = {name: float(values[0]) for name, values in given.items()}
    if options.modes:
        return show_modes(machine, at, None if options.output is None else picture(options, machine))
    equations = printed_equations(machine, options, at) if options.equations else None  # refused before a word is printed
    if equations is not None and options.latex:
        print(equations.latex())
        return 0
    plan = machine.plan
    print_section(f"{type(machine).__name__}: strokes", text_columns([*stroke_rows(machine)]).splitlines())
    print_section("Design variables", text_columns([*design_rows(machine)]).splitlines())
    names = plan.link_names  # the links and cylinders that bodies are: `boom.beam: boom.B boom.D`
    bodies = [f"{names[body.name]}: {body}" if body.name in names else str(body) for body in machine.links]
    bodies += [f"cylinder {spanning_name(plan, bar.P, bar.Q)}: {bar.P} {bar.Q}" for bar in plan.cylinders]
    count = f"{len(machine.strokes)} stroke{'s' if len(machine.strokes) != 1 else ''}"
    print_section("Bodies", [*bodies, f"Gruebler count {machine.gruebler} (a cylinder is two bodies on a slide), {count}"])
    changed = {name: value for name, value in machine.dimensions.items() if value != plan.defaults[name]}
    written = written_out(plan, changed)  # as this design has the members, without the dimensions listed already
    lines = [f"{name} = {with_units(plan, name, text)}" for name, text in written.items() if name not in plan.of_kind(Dimension)]
    print_section("Construction, in order", lines)
    if equations is not None:
        print_section("Equations", str(equations).splitlines(), fits=False)
    verdicts = machine.verdicts(over=over)
    print_section("Verdict", verdicts, fits=sys.stdout.isatty())  # else a rule a line, for programs that read it
    about: list[str] = []  # its paragraphs as wide as the terminal; indented lines stay as they are written
    for each in re.split(r"\n[ \t]*\n", cleandoc(type(machine).__doc__ or "")):
        about += [*(each.splitlines() if re.search(r"^[ *-]", each, re.MULTILINE) else wrapped(" ".join(each.split()), "")), ""]
    print_section("About it", about[:-1], fits=False)
    return judged_code(verdicts, options)


def check_asked(options: Namespace) -> None:
    """Raise DefinitionError for options of equations without these, and for numbers in LaTeX."""
    given = {"--start": options.start, "--ratio": options.ratio, "--wrt": options.wrt, "--forces": options.forces}
    given |= {"--numbers": options.numbers, "--at": options.strokes, "--latex": options.latex}
    remedy = "say --modes too, or use `draw`"
    ensure(options.output is None or options.modes, f"-o {options.output}: the picture is of the assembly modes; {remedy}.")
    if options.modes:
        given.pop("--at")
    named = [name for name, value in given.items() if value not in (None, False, [])]
    ensure(options.equations or not named, f"{''.join(named[:1])} says how equations are printed; say --equations too.")
    ensure(options.wrt is None or options.ratio, f"--wrt {options.wrt}: it is the stroke of --ratio; say --ratio too, such as --ratio G.")
    fits = not options.latex or not (options.numbers or options.strokes)
    ensure(fits, "--latex prints symbols, not numbers; leave out --numbers and --at, or --latex.")


def show_modes(machine: Mechanism, at: dict[str, float], path: Path | None) -> int:
    """Print the assembly modes with the code that chooses each, draw them where a file is named, and return the exit code."""
    modes = machine.assemblies(**at)
    said = strokes_text(machine.plan, {name: stroke.start for name, stroke in machine.strokes.items()} | at)
    ensure(modes, f"{machine.plan.title} cannot be assembled in any mode at {said}; say --at with another stroke.")
    for number, mode in enumerate(modes, 1):
        said = ", ".join([*([str(mode)] * bool(str(mode))), *(["as declared"] * mode.is_declared)])
        print_section(f"{number}. {said}", mode.code.splitlines() or ["(no line changes)"], fits=False)
    if path is not None:
        from ..pictures import draw

        draw(modes).savefig(path)
        print(f"{path}: {len(modes)} assembly mode{'s' if len(modes) != 1 else ''}.")
    return 0


def printed_equations(machine: Mechanism, options: Namespace, at: Mapping[str, float]) -> Equations:
    """Return the equations as they are asked for."""
    from ..formulas import equations

    return equations(
        machine, start=options.start or 1, ratio=options.ratio or (), wrt=options.wrt, forces=options.forces, numbers=options.numbers,
        at=at or None,
    )  # fmt: skip


def print_section(title: str, lines: Iterable[object], *, fits: bool = True) -> None:
    """Print a section, its lines as wide as the terminal where they shall fit; nothing where it has no lines."""
    text = [part.rstrip() for line in lines for part in (wrapped(f"{line}", "  ", "     ") if fits else [f"  {line}"])]
    if any(text):
        print("\n".join([title, *text, ""]))
