"""The doors to what is looked at and handed on: thin functions. The libraries behind them are loaded where one is first called."""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, overload

import numpy as np

from .assembly import Assembly
from .errors import DefinitionError
from .mechanism import Mechanism
from .motion import Column, Motion, RequestLike
from .reports import NOTHING

if TYPE_CHECKING:
    from os import PathLike

    import networkx as nx
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from .formulas import Equations
    from .loads import Acting, Case, Loads
    from .motion.measures import Measure
    from .pictures import Drawing
    from .pictures.film import Progress
    from .quantities import Quantity
    from .study import Front, Optimum


@overload
def draw(machine: Motion, *, ax: Axes, pose: int | tuple[int, ...] = ..., faint: bool = ...) -> Drawing: ...
@overload
def draw(machine: Optimum, *, count: int = ...) -> Figure: ...
@overload
def draw(machine: Sequence[Assembly]) -> Figure: ...
@overload
def draw(machine: Sequence[Mechanism], at: Any = ..., path: Sequence[str] = ..., count: int = ...) -> Figure: ...
@overload
def draw(
    machine: Mechanism | Motion,
    at: Any = ...,
    path: Sequence[str] = ...,
    count: int = ...,
    *,
    ax: None = ...,
    pose: int | tuple[int, ...] = ...,
    faint: bool = ...,
    forces: bool | str = ...,
    loads: Loads = ...,
    case: Case = ...,
    direction: str = ...,
    drive: str | None = ...,
    velocities: Mapping[str, Any] | None = ...,
    pole: bool | str | tuple[str, str] = ...,
) -> Figure: ...
@overload
def draw(machine: nx.MultiGraph) -> Figure: ...
def draw(
    machine: Mechanism | Motion | Optimum | nx.MultiGraph | Sequence[Assembly] | Sequence[Mechanism],
    at: Any = None,
    path: Sequence[str] = (),
    count: int = 101,
    *,
    ax: Axes | None = None,
    pose: int | tuple[int, ...] = 0,
    faint: bool = False,
    forces: bool | str = False,
    loads: Loads = None,
    case: Case = None,
    direction: str = "frictionless",
    drive: str | None = None,
    velocities: Mapping[str, Any] | None = None,
    pole: bool | str | tuple[str, str] = False,
) -> Figure | Drawing:
    """Return a figure of a mechanism at chosen strokes, the last one bold and the others faint; or a motion at one of its poses.

    Of a mechanism, `at` are values of the first stroke [m or rad], or a mapping `dict(S=[0.0, 0.25])` for another or for
    several; without it, the two ends of the first stroke, the others in their middle. A full turn is drawn where its
    pins stand apart, with what the machine is about at its least and greatest, faint.
    `path` names points whose paths are drawn over that stroke, at `count` poses. Poses out of reach are left out, and the
    picture says so; where none is in reach this raises AssemblyError.

    Of a motion, `pose` is an index into its strokes, an int for the flat one; on axes that are given, the drawing comes back, whose
    `update(pose)` moves it. Empty axes become a sheet with equal scales that has room for the whole motion. A faint mechanism has
    no names. Raises DefinitionError for a batch of designs, an unknown name or a pose that is not there.

    Over the pose, the bold one of several, are laid: with `forces=True` the pin forces and loads as arrows to one scale, with the name of
    a body, `forces="OBC"`, that body alone with all forces on it and their polygon; `loads`, `case`, `direction`, `drive` as `pin_forces`
    takes them. `velocities=dict(S=0.05)` gives the points' velocities at these stroke rates [1/s], which dampers get too. `pole="EDF"` is
    the body's instant centre, `pole=("EDF", "FKG")` that of two bodies, `pole=True` that of each body no fixed pin holds. Where a pose is
    refused the picture says why, for a motion without `unreachable="nan"` this raises SingularError.

    Of several designs, `draw([hitch, hitch.replaced(OB=0.32)])`, or a batch, all at the same strokes, in their middle unless `at` says
    others; of two the first one is faint, of more each has its own colour; up to 12. Of `machine.assemblies()`, a small picture of each
    mode with the line of code that chooses it.

    Of the result of a search, the machine before, faint, and after, bold, at both ends of its stroke, with how far each pin moved.

    Of `machine.graph`, the kinematic chain: its bodies, and the pins and slides between them.
    """
    from .pictures import draw, draw_chain, draw_designs, draw_modes, draw_optimum
    from .study import Optimum

    is_laid = ax is not None or velocities is not None or any(each is not None and each is not False for each in (faint, forces, pole))
    is_laid = is_laid or not (isinstance(pose, int) and pose == 0)
    if isinstance(machine, Sequence):
        modes = [each for each in machine if isinstance(each, Assembly)]
        designs = [each for each in machine if not isinstance(each, Assembly)]
        if is_laid or bool(modes) == bool(designs):
            raise DefinitionError(
                "draw([...]): one or more designs, with at=, path= and count= if wanted, or machine.assemblies() are expected."
            )
        return draw_designs(designs, at, path, count) if designs else draw_modes(modes)
    if "networkx" in sys.modules and isinstance(machine, sys.modules["networkx"].MultiGraph):
        if at is not None or path or is_laid:
            raise DefinitionError("draw(machine.graph): a graph has no poses; it is drawn by itself.")
        return draw_chain(machine)
    if isinstance(machine, Mechanism) and not is_laid and any(map(np.ndim, machine.dimensions.values())):
        return draw_designs([machine], at, path, count)
    if isinstance(machine, Optimum):
        if at is not None or path or is_laid:
            title = machine.problem.plan.title
            raise DefinitionError(f"{title}: a search's result is drawn at the ends of its stroke; it takes count= alone.")
        return draw_optimum(machine, count)
    return draw(
        machine, at, path, count, ax=ax, pose=pose, faint=faint, forces=forces, loads=loads, case=case, direction=direction, drive=drive,
        velocities=velocities, pole=pole,
    )  # fmt: skip


@overload
def plot(motion: Optimum) -> Figure: ...
@overload
def plot(motion: Motion, columns: Sequence[Column | RequestLike], *, limits: Mapping[str, Sequence[Any]] | None = ...) -> Figure: ...
@overload
def plot(
    motion: Mechanism,
    columns: Sequence[Column | RequestLike] = ...,
    *,
    limits: Mapping[str, Sequence[Any]] | None = ...,
    at: Mapping[str, Any] = ...,
    count: int = ...,
) -> Figure: ...
def plot(
    motion: Motion | Mechanism | Optimum,
    columns: Sequence[Column | RequestLike] = (),
    *,
    limits: Mapping[str, Sequence[Any]] | None = None,
    at: Mapping[str, Any] = NOTHING,
    count: int = 101,
) -> Figure:
    """Return a figure of columns over the stroke, a panel each; a column that is the stroke itself is left out.

    A column may go by its name: a named output, or a point's coordinate such as "G_y"; a request, `drive_force()`, is one under its own
    words. Of a machine the columns of its table of results have names too, those it is about are drawn where none is named, with their
    limits (`Mechanism.featured`); it runs as in `animate`, `at=dict(tilt=0.1)`, at `count` poses. `limits` are, by the column's name,
    `(value [SI], text)` or `(value, text, "below")`: the line is drawn and the side that fails, above unless said, is shaded.
    Raises DefinitionError for a batch, a grid, or an unknown name.

    Of the result of a search, the quantity of the objective and of each condition over the stroke, before and after, with its limit.
    """
    from .pictures import plot, plot_machine, plot_optimum
    from .study import Optimum

    if isinstance(motion, Optimum):
        if columns or limits is not None or at:
            raise DefinitionError(f"{motion.problem.plan.title}: a search's result has its own curves and limits; write plot(optimum).")
        return plot_optimum(motion)
    if isinstance(motion, Mechanism):
        return plot_machine(motion, columns, limits, at, count)
    if at or count != 101:
        raise DefinitionError("plot(motion, ...): a motion has its poses; at= and count= go with a machine, plot(machine, at=...).")
    return plot(motion, columns, limits=limits)


def animate(
    machine: Mechanism,
    path: str | Path,
    *,
    count: int = 60,
    column: str | None = None,
    trace: Sequence[str] | None = None,
    limit: Sequence[Any] | None = None,
    at: Mapping[str, Any] = NOTHING,
    progress: Progress | None = None,
) -> Path:
    """Return the path of the animation it wrote: a .gif, an .mp4 (extra `video`) or an .html page that works offline.

    The mechanism runs over its first stroke, there and back (a full turn goes round), at `count` poses; beside it the live
    curve of a column of its results. `at=dict(tilt=0.1)` holds another stroke, `at=dict(S=(0.1, 0.2))` says where one runs [m or rad],
    and `at=dict(lift=(0.0, 0.6, 0.6), tilt=(0.1, 0.1, 0.0))` how several run together, from value to value; strokes not named stand in
    their middle. `trace` names points whose paths are drawn; `limit` is the column's limit, `(value [SI], text, "above" or "below")`.
    What is not given is what the machine is about (`Mechanism.featured`), else the last column that changes, no path and no limit.
    `progress(done, total)` is called as it goes. What stood at the
    path is replaced whole, or left as it was. Raises DefinitionError for another kind of file, a batch of designs or an unknown
    name, FileError for a path that cannot be written.
    """
    from .pictures import animate

    return animate(machine, path, count=count, column=column, trace=trace, limit=limit, at=at, progress=progress)


def page(
    machine: Mechanism,
    path: str | Path,
    *,
    vary: Sequence[str] | Mapping[str, Sequence[float] | None] | None = None,
    columns: Sequence[Column | RequestLike] | None = None,
    column: str | None = None,
    trace: Sequence[str] | None = None,
    limit: Sequence[Any] | Mapping[str, Sequence[Any]] | None = None,
    at: Mapping[str, Any] = NOTHING,
    count: int = 101,
    language: str = "en",
) -> Path:
    """Return the path of the live page it wrote, .html: one file without network access, in which the mechanism moves and changes.

    Every stroke has a slider, and so have the dimensions of `vary`, `["OB", "CD"]` or with their ranges [SI], `{"OB": (0.28, 0.34)}`, of a
    point "M" both coordinates; without it the first lengths, a mass and a bore. All others can be added in the page, and pins on the
    ground can be dragged. Everything is worked out anew in the browser by the machine's own program; a value goes only as far as the
    mechanism can be assembled, and the page says which step is how much short.

    `columns` are what its chooser offers, names of columns or requests such as `capacity("lift", "G")`, by default the table of
    results; `column` is shown first, else what the machine is about. A column that no program gives is shown for the delivered design
    alone, with the reason. `limit` is the limit of that column, `(value [SI], text, "above" or "below")`, or limits by column. `trace`
    names points whose paths are drawn, `at=dict(tilt=0.1)` holds another stroke, `at=dict(S=(0.1, 0.2))` says where one runs [m or rad],
    `count` is the number of poses of the curve. The page speaks English and Russian, `language` is the one it begins with.

    Raises DefinitionError for a batch of designs, an unknown name, or a file that does not end in .html, FileError for a path that cannot
    be written.
    """
    from .pictures import page

    return page(
        machine, path, vary=vary, columns=columns, column=column, trace=trace, limit=limit, at=at, count=count, language=language
    )  # fmt: skip


def export(
    what: Mechanism | Motion,
    path: str | PathLike[str],
    *,
    at: Mapping[str, Any] = NOTHING,
    count: int = 101,
    trace: Sequence[str] = (),
    columns: Sequence[Column] = (),
) -> Path:
    """Return the path of the file it wrote for another program: `export(hitch, "hitch.xlsx")`. The ending of the name says which.

    .xlsx (extra `xlsx`): a workbook of live formulas, the numbered equations one after the other at `count` poses of a stroke; a dimension
    typed over changes all of it. `at=dict(tilt=0.1)` holds a stroke, `at=dict(S=(0.1, 0.2))` says where one runs. What no formula gives
    (pins found by iteration) is a number there, marked so.
    .csv: the table of results in full precision: of a machine over its strokes, `count` poses each of those that `at` does not give; of a
    motion at its poses, its points and outputs or the `columns` given.
    .dxf (extra `cad`) and .svg: a drawing in millimetres, true size, by layers: of a machine at the strokes that `at` gives, a pose each
    (default: the start of the first stroke); of a motion all its poses. `trace` names points whose paths are drawn.

    What stood at the path is replaced whole, or left as it was. Raises DefinitionError for another kind of file, for what does not go with
    it, a batch of designs, and where the extra is not installed; AssemblyError for poses out of reach; FileError for a path that cannot be
    written.
    """
    from .exports import export

    return export(what, path, at=at, count=count, trace=trace, columns=columns)


def equations(
    machine: Mechanism | type[Mechanism],
    *,
    start: int = 1,
    numbers: bool = False,
    at: Mapping[str, float] | None = None,
    ratio: str | Sequence[str] = (),
    wrt: str | None = None,
    forces: bool = False,
) -> Equations:
    """Return a mechanism's equations, numbered from `start`, in the vector method's primitives: text, LaTeX, SymPy and numbers.

    `print(equations(hitch))` lists them. `numbers` fills the numbers in at the pose `at` (default: the start of each stroke). `ratio`
    names points and outputs whose derivatives by the stroke `wrt` are added; `forces` adds those of the loads, the driving forces by
    virtual work, and what cylinders and circuits have, all without friction. Source of notation and order: Dyuzhev, Kotov,
    Chuprynin, "Universality of the hitch of the power vehicle UES-2-250A" (Minsk, 2008), equations (4) to (27).
    """
    from .formulas import equations

    return equations(machine, start=start, numbers=numbers, at=at, ratio=ratio, wrt=wrt, forces=forces)


def report(
    machine: Mechanism,
    path: str | Path,
    *,
    language: str | None = None,
    units: str | None = None,
    case: Any = None,
    over: Any = None,
    acting: Acting | None = None,
    at: Mapping[str, Any] = NOTHING,
    count: int = 11,
    columns: Sequence[str] | None = None,
    trace: Sequence[str] | None = None,
    limits: Mapping[str, Sequence[Any]] | None = None,
    title_block: Mapping[str, str] = NOTHING,
    start: int = 1,
) -> Path:
    """Return the path of the calculation report it wrote: .html, in one file; .pdf, A4; or .md with its pictures in FILE_files.

    It has the inputs with units and sources, drawings with dimensions, the numbered equations with numbers filled in, from `start` on,
    tables and curves, the largest pin forces, limits of motion, checks with their measured figures, verdicts, the version and a hash of
    the inputs. The same inputs give the same bytes. Tables and curves run along one stroke; what is judged, the verdicts, the largest
    forces and the worst places, is over all that the machine runs, its `overs` or what is given as `over`.

    `language` ("en", "ru") and `units` ("si", "bar-mm", "kgf", "us") are those that hold already unless named. `case` names one load
    case; without it all are looked at, or `acting` says loads, case and direction in one. `at` holds strokes or says between which
    values one runs [m or rad], as for `animate`; `count` is the number of rows of the tables, `columns` the results shown, `trace` the
    points whose paths are drawn, `limits` as `plot` takes them. `title_block` adds rows to the title block, `{"Checked by": "N. N.",
    "Date": "2026-05-01"}`. What stood at the path is replaced whole. Raises DefinitionError for a batch of designs, another kind of file
    or an unknown name, AssemblyError where no pose is in reach.
    """
    from .documents import report

    return report(
        machine, path, language=language, units=units, case=case, over=over, acting=acting, at=at, count=count, columns=columns,
        trace=trace, limits=limits, title_block=title_block, start=start,
    )  # fmt: skip


@overload
def optimise(
    machine: Mechanism,
    *,
    minimise: Measure | Quantity | str | None = ...,
    maximise: Measure | Quantity | str | None = ...,
    vary: Mapping[Any, Any],
    subject_to: Any = ...,
    case: Any = ...,
    over: Mapping[str, Any] | None = ...,
    robust: Mapping[str, Any] | None = ...,
    sigmas: float = ...,
    method: str = ...,
    solver: str = ...,
    starts: int | None = ...,
    seed: int = ...,
    limit: int | None = ...,
    folder: str | PathLike[str] | None = ...,
    progress: Any = ...,
) -> Optimum: ...
@overload
def optimise(
    machine: Mechanism,
    *,
    minimise: Sequence[Measure | Quantity] = ...,
    maximise: Sequence[Measure | Quantity] = ...,
    vary: Mapping[Any, Any],
    subject_to: Any = ...,
    case: Any = ...,
    over: Mapping[str, Any] | None = ...,
    solver: str = ...,
    seed: int = ...,
    limit: int | None = ...,
    progress: Any = ...,
) -> Front: ...
def optimise(
    machine: Mechanism,
    *,
    minimise: Any = None,
    maximise: Any = None,
    vary: Mapping[Any, Any],
    subject_to: Any = (),
    case: Any = None,
    over: Mapping[str, Any] | None = None,
    robust: Mapping[str, Any] | None = None,
    sigmas: float = 3.0,
    method: str = "auto",
    solver: str = "slsqp",
    starts: int | None = None,
    seed: int = 0,
    limit: int | None = None,
    folder: str | PathLike[str] | None = None,
    progress: Any = False,
) -> Optimum | Front:
    """Return the best design of a machine: `optimise(hitch, maximise=least(capacity("lift", "G")), vary={"OB": (0.27, 0.33)})`.

    What is to be least or greatest is one number of a design: `least(q)`, `most(q)`, `integral(q)`, `at(q, S=...)` of a quantity q (an
    output, `drive_force()`, `pin_force("O")`, ...) and arithmetic of them; `subject_to` are comparisons of such, `most(abs(ref("tilt"))) <=
    8 * deg`. They hold over the whole stroke, between the poses too; that every pose is assembled is always kept.

    `vary` says what may change: `"OB": (low, high)` [SI], with a third number in steps; `"M": around(60 * mm)`, of a point both
    coordinates; a list of choices; and for several names at once rows of a catalogue, `("lift.bore", "lift.rod"): [(0.1, 0.056), ...]`.
    `over={"S": (0.0, 0.2)}` looks at a part of the stroke; an end may be a quantity that follows the design. `case` names a load case or
    several, all of which are kept and the worst of which counts.

    Of several objectives, given as lists, the front comes back: designs of which none is better in all (extra `pareto`). With
    `robust={"OB": 0.2 * mm}` every number counts as bad as `sigmas` standard deviations make it, by tolerances as in `tolerance`.

    From the best of some hundred designs spread over the box, `starts` of them for each combination of choices, a `solver` ("slsqp" or
    "trust-constr") goes on with exact derivatives. `method="local"` begins with the machine as it is, "evolution" with the best of a
    differential evolution. The same seed gives the same result. `limit` is how many designs are looked at before the best so far comes
    back, with a word that it is that; by default as many as take about a minute. With `folder` finished searches are kept there, and the
    same call goes on where another one stopped; `progress=True` shows a bar.

    A design that has no value of a condition at some pose does not keep it, and a quotient whose divisor passes zero within the stroke has
    no value. Lengths, angles, forces and pressures neither add nor compare. What limits the result is said: conditions, ends of ranges,
    and where the machine itself allows no more.

    Raises DefinitionError for what cannot be asked, StudyError where no design can be assembled over the whole stroke, and its
    InfeasibleError, with the conflict, the least relaxation and what one condition alone would have to give, where none keeps all.
    """
    from .study.optimise import optimise

    return optimise(
        machine, minimise=minimise, maximise=maximise, vary=vary, subject_to=subject_to, case=case, over=over, robust=robust,
        sigmas=sigmas, method=method, solver=solver, starts=starts, seed=seed, limit=limit, folder=folder,
        progress=progress,
    )  # fmt: skip
