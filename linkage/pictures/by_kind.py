"""The pictures of `linkage.draw` and `linkage.plot`: by the kind of object, a machine, a motion, designs, modes, a search, a chain."""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, TypeAlias, overload

import numpy as np

from ..assembly import Assembly
from ..errors import ensure, is_yes, require
from ..mechanism import Mechanism
from ..motion import Column, Motion, RequestLike
from ..reports import NOTHING
from ..study import Optimum, WorkingField
from ..synthesis import Synthesis
from ..synthesis.exact_poses import Burmester
from .chain import draw_chain
from .curves import plot_machine, plot_motion
from .designs import draw_designs, draw_modes
from .force_arrows import force_question
from .load_chart import plot_field
from .optimum import draw_optimum, plot_optimum
from .overlays import Overlays
from .poses import draw_machine
from .synthesis import draw_burmester, draw_synthesis

if TYPE_CHECKING:
    import networkx as nx
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from ..loads import Case, Loads
    from .drawing import Drawing
    from .scene import Pose

    Drawable: TypeAlias = Mechanism | Motion | Optimum | Synthesis | Burmester | nx.MultiGraph | Sequence[Assembly] | Sequence[Mechanism]


@overload
def draw(machine: Motion, *, ax: Axes, pose: Pose = ..., time: float | None = ..., faint: bool = ...) -> Drawing: ...
@overload
def draw(
    machine: Drawable,
    at: object = ...,
    path: Sequence[str] = ...,
    count: int = ...,
    *,
    ax: None = ...,
    pose: Pose = ...,
    time: float | None = ...,
    faint: bool = ...,
    forces: bool | str = ...,
    loads: Loads = ...,
    case: Case = ...,
    direction: str | None = ...,
    drive: str | None = ...,
    velocities: Mapping[str, object] | None = ...,
    pole: bool | str | tuple[str, str] = ...,
    clearance: bool | tuple[str, str] = ...,
    freedom: bool = ...,
    answers: int | None = ...,
) -> Figure: ...
def draw(
    machine: Drawable,
    at: object = None,
    path: Sequence[str] = (),
    count: int = 101,
    *,
    ax: Axes | None = None,
    pose: Pose = 0,
    time: float | None = None,
    faint: bool = False,
    forces: bool | str = False,
    loads: Loads = None,
    case: Case = None,
    direction: str | None = None,
    drive: str | None = None,
    velocities: Mapping[str, object] | None = None,
    pole: bool | str | tuple[str, str] = False,
    clearance: bool | tuple[str, str] = False,
    freedom: bool = False,
    answers: int | None = None,
) -> Figure | Drawing:
    """Return a figure of a mechanism at chosen strokes, the last one bold and the others faint; or a motion at one of its poses.

    Of a mechanism, `at` are values of the first stroke [m or rad], or a mapping `dict(S=[0.0, 0.25])` for another or for
    several; without it, the two ends of the first stroke, the others in their middle. A full turn is drawn where its
    pins stand apart, with what the machine is about at its least and greatest, faint.
    `path` names points whose paths are drawn over that stroke, at `count` poses. Poses out of reach are left out, and the
    picture says so; where none is in reach this raises AssemblyError.

    Of a motion, `pose` is an index into its strokes, an int for the flat one. Over a path in time `time` is an instant [s] in its place,
    whether or not it is one of the motion's own. On axes that are given the drawing comes back, whose `update(pose)` moves it. Empty axes
    become a sheet with equal scales that has room for the whole motion. A faint mechanism has no names.
    Raises DefinitionError for a batch of designs, an unknown name or a pose that is not there.

    More is laid over the pose, the bold one of several. `forces=True` gives the pin forces and loads as arrows to one scale. With the name
    of a body, `forces="OBC"`, that body stands alone with all forces on it and their polygon. With the name of a pin, `forces="O"`, these
    are the loads that turn about it and the forces that hold them, each with its lever arm. `loads`, `case`, `direction` and `drive` are
    as `pin_forces` takes them. `velocities=dict(S=0.05)` gives the points' velocities at these stroke rates [1/s], which dampers get too.
    `pole="EDF"` is the body's instant centre, `pole=("EDF", "FKG")` that of two bodies, `pole=True` that of each body no fixed pin holds.
    Where a pose is refused the picture says why; for a motion without `unreachable="nan"` this raises SingularError. With
    `clearance=True` a dimension stands between what comes nearest of all that the machine's `Planes` keep apart, with
    `clearance=("OBC", "MK")` between these two. A machine without `at` is then drawn where they come nearest in all that it runs. Of a
    motion its own worst pose is drawn, faint. `freedom=True` shows how bodies can move that nothing holds while the drives are locked,
    a colour for each way.

    Several designs, `draw([hitch, hitch.replaced(OB=0.32)])`, or a batch, stand at the same strokes, in their middle unless `at` says
    others. Of two the first one is faint, of more each has its own colour; up to 12. Of `machine.assemblies()`, a small picture of each
    mode with the line of code that chooses it.

    Of the result of a search, the machine before, faint, and after, bold, at both ends of its stroke, with how far each pin moved.

    Of what a synthesis found, its best machines stand side by side, three unless `answers` says how many. Each is beside its task, the
    points numbered: the path of the point over the whole stroke, and the machine at the first of them. What is missed is drawn so many
    times as long that it can be seen. Of a function the wanted values and the curve are drawn, of poses the body at each.

    Of `machine.graph`, the kinematic chain: its bodies, and the pins and slides between them. Of `burmester(...)`, the curves of circle and
    centre points, the poses, and the links.

    Parameters
    ----------
    machine : object
        A mechanism, a motion, designs, modes, the result of a search or of a synthesis, a graph.
    at : sequence or mapping, optional
        Values of the strokes [m or rad].
    path : sequence of str
        The points whose paths are drawn.
    count : int
        The number of poses of the paths.
    ax : matplotlib Axes, optional
        The axes to draw on.
    pose : int or tuple of int
        The pose of a motion.
    time : float, optional
        The instant of a motion in time [s].
    faint : bool
        Whether the mechanism is faint.
    forces : bool or str
        Whether forces are drawn, or the body or pin.
    loads : sequence of ForceElement or str, optional
        The loads; by default the machine's own.
    case : LoadCase or str, optional
        A load case, or its name.
    direction : str, optional
        "extending" while the stroke grows, "retracting", or "frictionless".
    drive : str, optional
        The stroke that moves.
    velocities : mapping, optional
        The rates of the strokes [1/s].
    pole : bool, str or tuple of str
        The bodies whose poles are drawn.
    clearance : bool or tuple of str
        The bodies whose gap is drawn.
    freedom : bool
        Whether motions of loose bodies are drawn.
    answers : int, optional
        The number of answers of a synthesis.

    Returns
    -------
    Figure or Drawing
        The figure; on given axes the drawing.

    Raises
    ------
    DefinitionError
        A batch of designs, an unknown name, a pose that is not there.
    AssemblyError
        No pose is in reach.
    SingularError
        The pose is refused.
    """
    laid = (faint, forces, pole, clearance, is_yes("freedom", freedom))
    is_laid = ax is not None or velocities is not None or any(each is not None and each is not False for each in laid)
    is_laid = is_laid or time is not None or not (isinstance(pose, int) and pose == 0)
    is_plain = at is None and not path and not is_laid
    if isinstance(machine, Synthesis):
        title = machine.start.plan.title
        ensure(is_plain, f"{title}: what a synthesis found is drawn beside its task; it takes answers= and count= alone.")
        return draw_synthesis(machine, 3 if answers is None else answers, count)
    require(answers is None, "draw(answers", answers, "answers are those of a synthesis; leave it out")
    if isinstance(machine, Sequence):
        modes = [each for each in machine if isinstance(each, Assembly)]
        designs = [each for each in machine if not isinstance(each, Assembly)]
        given = "one or more designs, with at=, path= and count= if wanted, or machine.assemblies()"
        ensure(not is_laid and bool(modes) != bool(designs), f"draw([...]): {given} are expected.")
        return draw_designs(designs, at, path, count) if designs else draw_modes(modes)
    if "networkx" in sys.modules and isinstance(machine, sys.modules["networkx"].MultiGraph):
        ensure(is_plain, "draw(machine.graph): a graph has no poses; it is drawn by itself.")
        return draw_chain(machine)
    if isinstance(machine, Mechanism) and not is_laid and any(map(np.ndim, machine.dimensions.values())):
        return draw_designs([machine], at, path, count)
    if isinstance(machine, Burmester):
        ensure(is_plain, "draw(burmester(...)): its poses are those that were given; it is drawn by itself.")
        return draw_burmester(machine)
    if isinstance(machine, Optimum):
        ensure(is_plain, f"{machine.problem.plan.title}: a search's result is drawn at the ends of its stroke; it takes count= alone.")
        return draw_optimum(machine, count)
    overlays = Overlays(force_question(forces, loads, case, direction, drive, velocities), velocities, pole, clearance, freedom)
    return draw_machine(machine, at, path, count, overlays, ax, pose, time, faint)


def plot(
    motion: Motion | Mechanism | Optimum | WorkingField,
    columns: Sequence[Column | RequestLike] = (),
    *,
    limits: Mapping[str, Sequence[object]] | None = None,
    at: Mapping[str, object] = NOTHING,
    count: int = 101,
) -> Figure:
    """Return a figure of columns over the stroke, a panel each; a column that is the stroke itself is left out.

    A column may go by its name: a named output, or a point's coordinate such as "G_y"; a request, `drive_force()`, is one under its own
    words. Of a machine the columns of its table of results have names too, those it is about are drawn where none is named, with their
    limits (`Mechanism.featured`). It runs over all that it declares as `Over`s, each with panels of its own in a load case that occurs
    there, else as in `animate`, `at=dict(tilt=0.1)`; at `count` poses. `limits` are, by the column's name,
    `(value [SI], text)` or `(value, text, "below")`: the line is drawn and the side that fails, above unless said, is shaded.
    A reserve is drawn as 1/reserve in %, the load's share of what the pump can carry.
    Raises DefinitionError for a batch, a grid, or an unknown name.

    Of a working field it is the load chart: heights by radii, in each cell the load and a letter for what limits it. Of the result of a
    search, the quantity of the objective and of each condition over the stroke, before and after, with its limit.

    Parameters
    ----------
    motion : Motion, Mechanism, Optimum or WorkingField
        The object to plot.
    columns : sequence
        Columns, their names, or requests.
    limits : mapping, optional
        Limits by the column's name: `(value [SI], text)` or `(value, text, "below")`.
    at : mapping
        Strokes to hold, or to run between values, by name [m or rad].
    count : int
        The number of poses.

    Returns
    -------
    Figure
        The figure.

    Raises
    ------
    DefinitionError
        A batch, a grid, an unknown name.
    """
    is_alone = not columns and limits is None and not at
    if isinstance(motion, WorkingField):
        ensure(is_alone, f"{motion.machine.plan.title}: a working field is drawn as it is; write plot(field).")
        return plot_field(motion)
    if isinstance(motion, Optimum):
        ensure(is_alone, f"{motion.problem.plan.title}: a search's result has its own curves and limits; write plot(optimum).")
        return plot_optimum(motion)
    if isinstance(motion, Mechanism):
        return plot_machine(motion, columns, limits, at, count)
    ensure(not at and count == 101, "plot(motion, ...): a motion has its poses; at= and count= go with a machine, plot(machine, at=...).")
    return plot_motion(motion, columns, limits)
