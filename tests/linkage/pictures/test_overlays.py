"""Forces, velocities and poles over a mechanism: arrows as statics and kinematics say, in one scale, with values that can be read."""

from dataclasses import replace
from functools import cache
from importlib.metadata import entry_points
from itertools import combinations, product
from operator import attrgetter

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.lines import Line2D
from matplotlib.text import Text
from numpy.testing import assert_allclose

from linkage import (
    LEFT,
    Acting,
    Crank,
    DefinitionError,
    Dyad,
    Force,
    Ground,
    LinkMass,
    Mechanism,
    Moment,
    OnLink,
    Outline,
    Planes,
    SingularError,
    Spring,
    Stroke,
    Weight,
    clearance,
    deg,
    draw,
    gap,
    least,
    mm,
    pin_forces,
    standing,
)
from linkage.motion import nearest_places, whole_body
from linkage.motion.gaps import shape_named
from linkage.pictures import style
from linkage.pictures.arrows import significant
from linkage.pictures.force_arrows import ForceQuestion, ForcesAt, force_layer, forces_at_pose, lever_arms, moment_about
from linkage.pictures.gap_marks import assumed_pairs, gap_mark
from linkage.pictures.overlays import asked_poles, pole_marks, pole_rates
from linkage.pictures.page_forces import PageSituation, force_arrows
from mechanisms.at_work.excavator import Excavator
from mechanisms.at_work.one_pump import RegenerativePress
from mechanisms.classics.four_bar import FourBar
from mechanisms.classics.roberts import Roberts
from mechanisms.crane import Crane
from mechanisms.header_balancer import HeaderBalancer
from mechanisms.mower_lift import MowerLift
from mechanisms.three_point_hitch import ThreePointHitch
from tests import shipped
from tests.for_all import first_daily, for_all
from tests.linkage.statics.test_vehicle import Digger, Truck
from tests.machines.test_tipper import Tipper

SHIPPED = list(shipped.MACHINES.values())
FIRST = "ThreePointHitch", "ThreeHeaders"
LOADED = [each for each in SHIPPED if each.plan.of_kind(Weight) or each.plan.of_kind(Moment) or each.plan.of_kind(Force)]


class Press(Mechanism):
    """All kinds of loads on a rocker: a moment, a mass of its own, a spring, a force; a crank drives it."""

    phi = Stroke(20 * deg, 100 * deg)
    O = Ground(0.0, 0.0)
    C = Ground(0.5, 0.0)
    W = Ground(0.9, 0.2)
    A = Crank(O, OA=0.12, angle=phi)
    B = Dyad(A, C, AB=0.5, CB=0.3, side=LEFT)
    P = OnLink(A, B, AP=0.6, BAP=10 * deg)
    drag = Moment("C B", M=-250.0)
    own = LinkMass("A B", mass=30.0, at=(0.2, 0.05))
    plate = LinkMass("A B P", mass=12.0)
    pull = Force(P, (400.0, -300.0))
    coil = Spring(B, W, stiffness=4000.0, free_length=0.3)


def pose_of(machine, share=0.37):
    """Return a machine's motion at one pose inside its strokes."""
    return machine.at(**{name: each.start + share * (each.end - each.start) for name, each in machine.strokes.items()})


def named(figure, begin):
    """Return what in a figure goes by a name that begins so."""
    return {each.get_gid(): each for each in figure.findobj(lambda artist: str(artist.get_gid() or "").startswith(begin))}


def vector_of(patch):
    """Return an arrow's tail and its vector from its outline; of a dot, nothing of a vector."""
    if not hasattr(patch, "get_xy") or len(patch.get_xy()) < 7:
        return np.array(patch.get_center()), np.zeros(2)
    corners = patch.get_xy()
    tail = 0.5 * (corners[3] + corners[4])
    return tail, corners[0] - tail


def arrows(figure, begin):
    """Return the arrows whose names begin so: tail and vector [m]."""
    return {name: vector_of(each) for name, each in named(figure, begin).items() if not name.endswith(" value")}


def dots(figure, begin):
    """Return how many arrows are so small that they are dots."""
    return sum(hasattr(each, "get_center") for each in named(figure, begin).values())


def scale_of(figure, unit):
    """Return the length on the sheet of a unit, by the bar and its text [m]."""
    bar, text = named(figure, f"scale {unit}")[f"scale {unit}"], named(figure, f"scale {unit}")[f"scale {unit} value"]
    value, said = text.get_text().split()
    assert said == unit
    return float(np.ptp(bar.get_xdata())) / float(value)


# -- forces ------------------------------------------------------------------------------------------------


@cache
def with_forces(kind):
    """Return a machine's motion at a pose, and its picture with the forces, which several tests read."""
    motion = pose_of(kind())
    return motion, draw(motion, forces=True)


@first_daily(1, "machine", [Press, *sorted([*LOADED, Tipper], key=lambda each: each.__name__ not in FIRST)], ids=attrgetter("__name__"))
def test_arrows_are_the_pin_forces_and_loads_in_one_scale(machine):
    motion, figure = with_forces(machine)
    found = forces_at_pose(motion, 0, ForceQuestion()).found
    drawn, size = arrows(figure, "force "), max(float(joint.size) for joint in found.joints if joint.has_force)
    assert len(drawn) == sum(joint.has_force and float(joint.size) > 1e-9 * size for joint in found.joints)  # none of zero
    if size == 0.0:
        return
    unit, factor = ("kN", 1e3) if named(figure, "scale kN") else ("N", 1.0)
    scale = scale_of(figure, unit) / factor
    for name, (tail, vector) in drawn.items():
        point, place, words = name.split(" ", 3)[1], int(name.split(" ", 3)[2]), name.split(" ", 3)[3]
        joint = found.joints[place]
        on, by = words.removeprefix("on ").split(" from ")
        assert {on, by} == {joint.on, joint.by} and on != "frame"
        sign = 1.0 if on == joint.on else -1.0
        assert_allclose(tail, motion[point], atol=1e-12)
        assert_allclose(vector, scale * sign * joint.force, atol=0.013 * scale * size)
        value = named(figure, f"{name} value")[f"{name} value"].get_text()
        assert_allclose(float(value.split()[0]) * factor, joint.size, rtol=5.1e-3, atol=1e-9 * size)
    loads = arrows(figure, "load ")
    total = sum((vector for _, vector in loads.values()), np.zeros(2))
    assert_allclose(
        total, scale * sum(acting.force for _, acting in found._loads), atol=(1e-9 + 0.012 * dots(figure, "load ")) * scale * size
    )


@first_daily(3, "machine", [Press, *sorted([*LOADED, Tipper], key=lambda each: each.__name__ not in FIRST)], ids=attrgetter("__name__"))
def test_a_force_on_a_page_acts_on_the_body_on_which_it_is_drawn(machine):
    motion = pose_of(machine())
    layer, couples = force_layer(ForcesAt(pin_forces(motion), 0)), []
    drawn = [(one.name, one.text, one.vector) for one in layer.arrows] + [(one.name, one.text, [one.moment]) for one in layer.turning]
    found = force_arrows(machine(), motion, [PageSituation(None)])
    for each in found:
        if each.by:
            words, kind = "" if each.by == "frame" else f"on {each.on}", "couple" if "couple" in each.parts else "force"
            there = [one for name, text, one in drawn if name.startswith(f"{kind} {each.point} ") and text.endswith(words)]
            shown = np.array([float(np.ravel(motion[part])[0]) for part in each.parts.values()])
            assert any(np.allclose(shown, one, rtol=1e-9) for one in there) or not np.linalg.norm(shown) > 1e-6, each.point
            couples += [each.point] * (kind == "couple")
    told = [name.split()[1] for name, *_ in drawn if name.startswith("couple ")]
    assert sorted(couples) == sorted(told) or not any(each.by for each in found)  # none of joints: the loads alone
    for each in found:
        if each.is_load:  # one arrow at one place in both, also of a mass that several points share
            kind, places = ("moment", layer.turning) if "couple" in each.parts else ("load", layer.arrows)
            shown = {part: float(np.ravel(motion[request])[0]) for part, request in each.parts.items()}
            at = [shown.get(part, motion[each.point][axis].item()) for axis, part in enumerate(("atX", "atY"))]
            size = [shown["couple"]] if kind == "moment" else [shown["x"], shown["y"]]
            there = [
                (one.at, [one.moment] if kind == "moment" else one.vector) for one in places if one.name.startswith(f"{kind} {each.on} ")
            ]
            assert any(np.allclose(spot, at) and np.allclose(one, size, rtol=1e-9) for spot, one in there) or not np.any(size), each.on


@pytest.mark.slow
def test_axle_loads_stand_at_the_supports_of_the_frame():
    motion = Digger().at(S=0.1, s=0.1)
    found = standing(motion, case="up")
    figure = draw(motion, forces=True, case="up")
    scale, drawn = scale_of(figure, "kN") / 1e3, arrows(figure, "load ")
    for support, point in (("front", "F"), ("rear", "R")):
        tail, vector = drawn[f"load {support} on frame"]
        assert_allclose(tail, motion[point], atol=1e-12)
        assert_allclose(vector, [0.0, scale * found.reactions[support]], atol=1e-12)
        value = named(figure, f"load {support} on frame value")[f"load {support} on frame value"].get_text()
        assert value == f"{significant(float(found.reactions[support]) / 1e3)} kN {support}"
    assert_allclose(drawn["load front along the ground on frame"][1], [scale * found.along, 0.0], atol=1e-12)
    level = draw(Digger(wind=(0.0, 0.0)).at(S=0.1, s=0.1), forces=True)
    assert named(level, "load front on frame") and not named(level, "load front along the ground")


@pytest.mark.slow
def test_the_free_body_of_a_vehicle_closes():
    for kind in (Digger, Truck):
        figure = draw(kind().at(S=0.1, s=0.1), forces="frame", case="down")
        drawn = arrows(figure, "polygon ")
        size = max(np.hypot(*vector) for _, vector in drawn.values())
        assert np.hypot(*sum(vector for _, vector in drawn.values())) <= 1e-12 * size
        assert any("Forces and moments balance" in text.get_text() for text in figure.findobj(Text))


def test_force_of_the_hitch_by_hand():
    """MK is a two-force bar: its pins' forces lie along it; about F the load and MK alone turn FKG."""
    motion, figure = with_forces(ThreePointHitch)
    found = arrows(figure, "force ")
    (tail, pull) = next(value for name, value in found.items() if name.startswith("force M "))
    bar = motion["K"] - motion["M"]
    assert abs(pull[0] * bar[1] - pull[1] * bar[0]) < 1e-9 * np.hypot(*pull) * np.hypot(*bar)
    scale = scale_of(figure, "kN") / 1e3
    weight, arm = 2000.0 * 9.80665, motion["G"] - motion["F"]
    lever = motion["K"] - motion["F"]
    along = bar / np.hypot(*bar)
    size = weight * arm[0] / abs(lever[0] * along[1] - lever[1] * along[0])
    assert_allclose(np.hypot(*pull), scale * size, rtol=1e-9)
    assert_allclose(tail, motion["M"], atol=1e-12)


@first_daily(1, "machine", [Press, ThreePointHitch], ids=lambda machine: machine.__name__)
def test_a_free_body_closes(machine):
    """The arrows on each body are in balance, forces and moments about a place anywhere; the polygon ends where it began."""
    motion = pose_of(machine())
    found = pin_forces(motion)
    for body in found.on_bodies:
        figure = draw(motion, forces=body)
        parts = {**arrows(figure, "force "), **arrows(figure, "load ")}
        if not parts or body == "frame":
            continue
        unit, factor = ("kN", 1e3) if named(figure, "scale kN") else ("N", 1.0)
        scale = scale_of(figure, unit) / factor
        largest = max(np.hypot(*vector) for _, vector in parts.values())
        loose = 1e-9 + 0.012 * (dots(figure, "force ") + dots(figure, "load "))
        assert_allclose(sum(vector for _, vector in parts.values()), 0.0, atol=loose * largest)
        couples = [
            float(text.get_text().split()[0])
            * factor
            * np.sign(turning_of(named(figure, name.removesuffix(" value"))[name.removesuffix(" value")]))
            for begin in ("couple ", "moment ")
            for name, text in named(figure, begin).items()
            if name.endswith(" value")
        ]
        moments = [(tail - 1.0) @ np.array([v[1], -v[0]]) / scale for tail, v in parts.values()]
        reach = max(np.hypot(*(tail - 1.0)) for tail, _ in parts.values())
        assert_allclose(sum(moments) + sum(couples), 0.0, atol=loose * largest / scale * reach + 5e-3 * sum(map(abs, couples)))
        chain = [vector for _, vector in arrows(figure, "polygon ").values()]
        assert_allclose(sum(chain), 0.0, atol=1e-9 * max(np.hypot(*vector) for vector in chain))


def turning_of(line):
    """Return which way a curved arrow goes: above zero counter-clockwise."""
    x, y = np.array(line.get_xydata()).T
    return float(np.sum((x - x.mean())[:-1] * np.diff(y) - (y - y.mean())[:-1] * np.diff(x)))


def test_own_mass_is_drawn_at_its_centre_of_gravity_and_a_moment_as_a_curve():
    motion, figure = with_forces(Press)
    A, B = motion["A"], motion["B"]
    along = (B - A) / np.hypot(*(B - A))
    centre = A + 0.2 * along + 0.05 * np.array([-along[1], along[0]])
    tail, vector = arrows(figure, "load own ")["load own on ABP"]
    assert_allclose(tail, centre, atol=1e-9)
    assert abs(vector[0]) < 1e-9 and vector[1] < 0.0
    on_page = [each for each in force_arrows(Press(), Press().sweep(3), [PageSituation(None)]) if each.on == "own"]
    (own,) = on_page
    assert own.point == "A" and own.is_load and own.on == "own"
    assert_allclose([motion[each] for each in own.parts.values()], [0.0, -30.0 * 9.80665, *centre], atol=1e-9)
    assert named(figure, "moment drag")["moment drag on CB value"].get_text() == "0.250 kNm drag"
    curve = np.array(named(figure, "moment drag")["moment drag on CB"].get_xydata())
    turn = curve - 0.5 * (motion["C"] + motion["B"])
    assert (turn[:-1, 0] * turn[1:, 1] - turn[:-1, 1] * turn[1:, 0] < 0.0).all()  # clockwise


def test_values_cover_neither_names_nor_each_other():
    figure = with_forces(ThreePointHitch)[1]
    renderer = FigureCanvasAgg(figure).get_renderer()
    boxes = {text.get_text(): text.get_window_extent(renderer) for text in figure.axes[0].texts if text.get_text()}
    assert len(boxes) > 15
    for (first, a), (second, b) in combinations(boxes.items(), 2):
        assert not a.overlaps(b), f"{first} covers {second}"


@pytest.mark.slow
def test_forces_over_the_bold_pose_of_several():
    machine = ThreePointHitch()
    figure = draw(machine, at=[0.0, 0.1], forces=True, path=["G"])
    tail, _ = arrows(figure, "load load")["load load on FKG"]
    assert_allclose(tail, machine.at(S=0.1)["G"], atol=1e-12)
    renderer, (ax,) = FigureCanvasAgg(figure).get_renderer(), figure.axes
    path = ax.transData.transform(machine.sweep(301)["G"].T)
    values = [text for text in ax.texts if text.get_text().endswith(("kN", "load"))]
    assert len(values) > 3
    for text in values:
        (left, bottom), (right, top) = text.get_window_extent(renderer).get_points()
        assert not ((path > (left, bottom)) & (path < (right, top))).all(axis=1).any(), text.get_text()


def test_no_load_is_said():
    note = named(draw(pose_of(FourBar()), forces=True), "note")["note"].get_text()
    assert note.startswith("no load acts, so that all forces are zero; declare one in the class")


class Dead(Mechanism):
    """A rocker that stands still at the start of its stroke: A, B and O in line."""

    S = Stroke(0.5, 0.7)
    A = Ground(0.0, 0.0)
    O = Ground(0.8, 0.0)
    B = Dyad(A, O, AB=S, OB=0.3, side=LEFT)
    load = Weight(B, mass=100.0)


@pytest.mark.slow
def test_what_a_pose_keeps_is_no_warning():
    poses = (ThreePointHitch(**given).at(S=0.1) for given in ({}, {"circuit.pressure": 20e5}))
    kept, short = (named(draw(motion, forces=True), "note")["note"].get_color() for motion in poses)
    assert kept == style.INK and short == style.ACCENT


def test_a_refused_pose_says_why():
    with pytest.raises(SingularError, match="stands at a dead point"):
        draw(Dead().at(S=0.5), forces=True)
    figure = draw(Dead().at(S=[0.6, 0.5], unreachable="nan"), pose=1, forces=True)
    assert named(figure, "note")["note"].get_text().startswith("No forces here: ")
    assert not arrows(figure, "force ")
    assert arrows(draw(Dead().at(S=[0.6, 0.5], unreachable="nan"), pose=0, forces=True), "force ")
    beyond = draw(Dead().at(S=[0.6, 0.4], unreachable="nan"), pose=1, forces=True, velocities=dict(S=0.1), pole="OB")
    assert "100 mm short" in named(beyond, "note")["note"].get_text()


def test_case_and_direction_are_those_of_pin_forces():
    machine = next(each for each in LOADED if each.__name__ == "Grapple")()
    motion = pose_of(machine)
    given = Force("A", (0.0, -1000.0))
    figure = draw(motion, forces=True, loads=given)
    assert [name for name in arrows(figure, "load ")] == ["load Force on OAC"]
    found = pin_forces(motion, given)
    joint = next(joint for joint in found.joints if joint.point == "O")
    (_, vector) = next(value for name, value in arrows(figure, "force O").items())
    unit = "kN" if named(figure, "scale kN") else "N"
    assert_allclose(vector / scale_of(figure, unit) * (1e3 if unit == "kN" else 1.0), joint.force, rtol=1e-9)


WRONG = {
    "an unknown body": (dict(forces="EDX"), "Body 'EDX' is unknown in ThreePointHitch"),
    "no word": (dict(forces=3), "draw(forces=3): say forces=True, or the body"),
    "loads without forces": (dict(loads=[]), "draw(loads=...) says of which forces; say forces=True"),
    "a direction without forces": (dict(direction="extending"), "draw(direction=...) says of which forces"),
    "no rates": (dict(velocities=0.05), "velocities=0.05: a value for each stroke is expected, such as velocities=dict(S=0.05)."),
    "another stroke's rate": (dict(velocities=dict(T=0.05)), "Stroke 'T' is unknown in ThreePointHitch"),
    "an unknown pole": (dict(pole="XY"), "Body 'XY' is unknown in ThreePointHitch"),
    "three bodies": (dict(pole=("EDF", "FKG", "MK")), "pole=('EDF', 'FKG', 'MK'): a body, pole=\"CD\""),
    "one body twice": (dict(pole=("EDF", "E D")), "these are one body; name two."),
}


@for_all("given, words", WRONG.values(), ids=WRONG)
def test_wrong_questions_are_refused_in_words(given, words):
    with pytest.raises(DefinitionError) as caught:
        draw(ThreePointHitch().sweep(3), **given)
    assert words in str(caught.value)


# -- loads with their lever arms about a pin ---------------------------------------------------------------


def about(machine, pin, case=None, **strokes):
    """Return the moments of the loads about a pin and of what holds them [Nm], with the lever arms by their lengths [m]."""
    at = machine.at(**strokes)
    (loads, held), arms = lever_arms(forces_at_pose(at, 0, ForceQuestion(pin, Acting(case=case))), at, pin, (0.0, 1.0, 0.0, 1.0), 0.01)
    moments = [moment_about(at[pin], list(layer.arrows), list(layer.turning)) for layer in (loads, held)]
    for arm in arms:  # square to the force, from the pin to its line of action
        (force,) = [each for each in (*loads.arrows, *held.arrows) if each.at is arm.start]
        line = arm.line.Q - arm.line.P
        assert_allclose(arm.line.P, at[pin], atol=1e-12)
        assert abs(line @ force.vector) < 1e-9 * np.hypot(*line) * force.length
        lever = abs((force.at - at[pin]) @ np.array([force.vector[1], -force.vector[0]])) / force.length
        assert_allclose(np.hypot(*line), lever, rtol=1e-9)
    return *moments, [float(np.hypot(*(arm.line.Q - arm.line.P))) for arm in arms]


def test_moments_about_the_cranes_pins_are_those_of_its_source():
    """K_A, K_A1 and K_B of the bounds (2.20), (2.39), (2.42) [Nm], where the arm is level; what holds the loads is in balance with them."""
    K_A, K_A1, K_B = 71905.1712, 39947.3173, 85260.0123
    crane = Crane()
    out = float(crane["l_t"])
    for pin, at, expected in (
        ("J", dict(phi=52 * deg, psi=142 * deg, t=out), -K_A),
        ("J", dict(phi=95 * deg, psi=5 * deg, t=0.0), K_A1),
        ("O", dict(phi=60 * deg, psi=150 * deg, t=out), -K_B * np.sin(60 * deg) - K_A),
    ):
        loads, held, _ = about(crane, pin, "lifting", **at)
        assert_allclose([loads, held], [expected, -expected], rtol=1e-7)


@first_daily(2, "machine", [MowerLift, HeaderBalancer, Press, Tipper], ids=lambda machine: machine.__name__)
def test_loads_about_a_pin_balance_what_holds_them(machine):
    pin = "C" if machine is Press else "O"
    strokes = {name: float(np.ravel(values)[0]) for name, values in pose_of(machine()).strokes.items()}
    loads, held, arms = about(machine(), pin, **strokes)
    assert arms
    assert_allclose(loads + held, 0.0, atol=1e-9 * (abs(loads) + abs(held)))


def test_a_lever_arm_is_drawn_with_its_length_and_the_moments_are_told():
    motion = MowerLift().at(S=0.6)
    figure = draw(motion, forces="O")
    arm = float(motion["G"][0] - motion["O"][0])
    texts = [text.get_text() for text in figure.findobj(Text)]
    assert significant(arm) in texts
    moment = significant(900 * 9.80665 * arm / 1e3)
    both = f"\N{MINUS SIGN}{moment} kNm of the loads, {moment} kNm of what holds them."
    assert f"Lever arms in m. Moments about O, counter-clockwise: {both}" in texts


@pytest.mark.parametrize(
    ("pin", "words"),
    [("A", "no body turns about A while one stroke runs"), ("E", "no load turns about E; name a pin about which a loaded body turns")],
)
def test_a_pin_about_which_no_load_turns_is_refused(pin, words):
    with pytest.raises(DefinitionError, match=words):
        draw(ThreePointHitch().at(S=0.1), forces=pin)


@pytest.mark.slow
def test_a_force_on_a_spring_names_it_once():
    """At the press's ram the spring's other end is a sliding block, which bears no name."""
    texts = {each.get_text() for each in draw(RegenerativePress().at(S=0.2), forces=True).axes[0].texts}
    assert any(text.endswith("kN on work") for text in texts) and not any("work on work" in text for text in texts)


# -- velocities and poles ----------------------------------------------------------------------------------


@shipped.over_machines()
def test_velocities_stand_square_on_the_rays_of_the_pole(machine):
    """For every body of every machine, each point's velocity is square to its ray; and as long as the turning says."""
    motion = pose_of(machine())
    rates = dict.fromkeys(motion.strokes, 0.3)
    speed = {point: motion.velocity(point, rates) for point in motion.plan.points}
    fastest = max(np.hypot(*v) for v in speed.values())
    for body in machine().links[1:]:
        pole = motion.pole(body.name, rates=rates)
        P, Q = body.points[:2]
        spin = (
            (speed[Q] - speed[P]) @ np.array([-1.0, 1.0] * np.array((motion[Q] - motion[P])[::-1])) / np.sum((motion[Q] - motion[P]) ** 2)
        )
        if np.isnan(pole).any():
            assert all(np.hypot(*speed[point]) < 1e-9 * fastest for point in body.points)
        elif np.isinf(pole).any():
            assert all(np.hypot(*(speed[point] - speed[P])) < 1e-6 * fastest for point in body.points)
        else:
            for point in body.points:
                ray = motion[point] - pole
                assert_allclose(speed[point], spin * np.array([-ray[1], ray[0]]), atol=1e-9 * max(fastest, abs(spin) * np.hypot(*ray)))


@first_daily(0, "machine", [ThreePointHitch, FourBar, Press], ids=lambda machine: machine.__name__)
def test_velocity_arrows_are_in_one_scale(machine):
    motion = pose_of(machine())
    rates = dict.fromkeys(motion.strokes, 0.3)
    figure = draw(motion, velocities=rates)
    unit, factor = ("m/s", 1.0) if named(figure, "scale m/s") else ("mm/s", 1e-3)
    scale = scale_of(figure, unit) / factor
    drawn = arrows(figure, "velocity ")
    moving = [point for point in motion.plan.points if np.hypot(*motion.velocity(point, rates)) > 0.0]
    assert sorted(drawn) == sorted(f"velocity {point}" for point in moving)
    for name, (tail, vector) in drawn.items():
        point = name.split()[1]
        assert_allclose(tail, motion[point], atol=1e-12)
        assert_allclose(vector, scale * motion.velocity(point, rates), rtol=1e-9)


def test_pole_of_a_coupler_is_where_crank_and_rocker_meet():
    motion = pose_of(Roberts())
    A, C, D, B = (motion[name] for name in "ACDB")
    share = np.linalg.solve(np.column_stack([C - A, B - D]), B - A)
    pole = motion.pole("CDP")
    assert_allclose(pole, A + share[0] * (C - A), rtol=1e-10)
    figure = draw(motion, pole="CDP")
    mark = named(figure, "pole of CDP")["pole of CDP"]
    assert_allclose(np.ravel(mark.get_data()), pole, rtol=1e-12)
    rays = [np.array(line.get_xydata()) for line in figure.axes[0].lines if line.get_gid() == "pole of CDP ray"]
    assert len(rays) == 3
    assert all(np.allclose(ray[0], pole) for ray in rays)


@first_daily(2, "name", ["watt_two", "three_point_hitch", "klann", pytest.param("jansen", marks=pytest.mark.slow)])
def test_three_poles_stand_in_a_line(name):
    """Kennedy and Aronhold: of any three bodies the three poles are in line."""
    machine = next(point for point in entry_points(group="hydrolinkage.machines") if point.name == name).load()
    motion = pose_of(machine())
    bodies = [body.name for body in motion.plan.links]
    checked = 0
    for trio in combinations(bodies, 3):
        poles = [motion.pole(body, other) for body, other in combinations(trio, 2)]
        if np.isfinite(poles).all() and np.abs(poles).max() < 1e3:
            first, second, third = poles
            area = (second - first)[0] * (third - first)[1] - (second - first)[1] * (third - first)[0]
            sides = sorted(float(np.hypot(*(a - b))) for a, b in combinations(poles, 2))
            assert abs(area) < 1e-9 * (1.0 + sides[-1]) ** 2
            checked += 1
    assert checked > 5


@pytest.mark.slow
def test_pole_over_a_sweep_is_the_centrode():
    machine = ThreePointHitch()
    motion = machine.sweep(5)
    path = motion.pole("FKG")
    assert path.shape == (2, 5)
    for place, stroke in enumerate(motion.strokes["S"]):
        assert_allclose(path[:, place], machine.at(S=float(stroke)).pole("FKG"), rtol=1e-12)
    line = named(draw(machine, pole="FKG"), "centrode of FKG")["centrode of FKG"]
    assert_allclose(np.array(line.get_data())[:, 0], machine.at(S=0.0).pole("FKG"), rtol=1e-9)


def test_a_body_that_only_translates_has_its_pole_at_infinity():
    machine = next(each for each in SHIPPED if each.__name__ == "Parallelogram")
    motion = pose_of(machine())
    assert np.isinf(motion.pole("ABP")).all()
    note = named(draw(motion, pole="ABP"), "note")["note"].get_text()
    assert note == "pole of ABP: at infinity, square to the velocity, since the body only translates here."


def test_two_bodies_of_one_motion_have_no_single_pole():
    loader = next(each for each in SHIPPED if each.__name__ == "FrontLoader")
    motion = pose_of(loader())
    stroke = next(iter(motion.strokes))
    assert np.isnan(motion.pole("OTE", wrt=stroke)).all()  # moved by the other cylinder


def test_batch_of_designs_has_a_pole_each():
    motion = ThreePointHitch(OB=np.array([0.3, 0.32])).sweep(3)
    assert motion.pole("FKG").shape == (2, 2, 3)
    assert_allclose(motion.pole("FKG")[:, 1], ThreePointHitch(OB=0.32).sweep(3).pole("FKG"), rtol=1e-12)


def test_a_pole_far_away_is_told():
    figure = draw(ThreePointHitch().at(S=0.0), pole="CD")
    note = named(figure, "note")["note"].get_text()
    x, y = ThreePointHitch().at(S=0.0).pole("CD")
    assert f"x = \N{MINUS SIGN}{abs(x):.3f} m, y = {y:.3f} m" in note


# -- strokes that move together ----------------------------------------------------------------------------


def test_header_and_path_are_of_the_same_strokes():
    crane = next(each for each in SHIPPED if each.__name__ == "Crane")()
    at = dict(phi=[30 * deg, 60 * deg, 50 * deg], psi=[40 * deg, 90 * deg, 120 * deg])
    figure = draw(crane, at=at, path=["T"], count=21)
    texts = [text.get_text() for text in figure.axes[0].get_legend().get_texts()]
    assert texts == ["phi = 30°, psi = 40°", "phi = 60°, psi = 90°", "phi = 50°, psi = 120°", "path of T"]
    path = next(np.array(line.get_data()) for line in figure.axes[0].lines if line.get_label() == "path of T")
    shown = crane.at(**at, t=0.5 * (crane.strokes["t"].start + crane.strokes["t"].end))["T"]
    for place in range(3):
        assert np.hypot(*(path - shown[:, place, None])).min() < 1e-12
    assert_allclose(path[:, [0, -1]], shown[:, [0, -1]], atol=1e-12)


# -- what comes nearest ------------------------------------------------------------------------------------


class Beside(ThreePointHitch):
    """A hitch whose bodies lie in three planes."""

    planes = Planes("OBC lift", "EDF MK", "CD", width=20 * mm)


def gap_lines(figure, pair):
    """Return the lines of the dimensions between a pair, from one place to the other, and what is written at them."""
    lines = figure.findobj(lambda artist: artist.get_gid() == f"gap {pair}" and isinstance(artist, Line2D))
    texts = [text.get_text() for text in figure.findobj(Text) if text.get_gid() == f"gap {pair} value"]
    return [np.array(line.get_xydata()) for line in lines[::3]], texts


@pytest.mark.slow
def test_the_worst_pose_is_drawn_with_what_comes_nearest_there():
    hitch = Beside()
    (answer,) = hitch.answers([least(clearance())])
    figure = draw(hitch, clearance=True)
    (line,), (words,) = gap_lines(figure, "C MK")
    assert_allclose(np.hypot(*(line[1] - line[0])), abs(answer.value), rtol=1e-6)
    assert words == f"{abs(answer.value) * 1e3:.3g} mm between C and MK"
    assert any(f"{answer.strokes['S'] * 1e3:.4g} mm" in text.get_text() for text in figure.findobj(Text))


@pytest.mark.slow
def test_a_motion_shows_the_gap_at_its_pose_and_faint_where_it_is_least():
    motion = Beside().sweep(21)
    values = motion[clearance()]
    figure = draw(motion, pose=3, clearance=True)
    lines, words = gap_lines(figure, "C MK")
    lengths = sorted(np.hypot(*(line[1] - line[0])) for line in lines)
    assert_allclose(lengths, sorted(abs(values[[int(np.argmin(values)), 3]])), rtol=1e-9)
    assert sum("S = " in text for text in words) == 1
    (alone,), _ = gap_lines(draw(motion, pose=int(np.argmin(values)), clearance=True), "C MK")
    assert_allclose(np.hypot(*(alone[1] - alone[0])), abs(values.min()), rtol=1e-9)


def test_two_bodies_are_named_without_planes():
    motion = ThreePointHitch().sweep(5)
    lines, words = gap_lines(draw(motion, pose=4, clearance=("lift", "CD")), "lift CD")
    wanted = motion[gap("lift", "CD")]
    assert_allclose(sorted(np.hypot(*(line[1] - line[0])) for line in lines), sorted({wanted[4], wanted.min()}), rtol=1e-9)
    assert any(word.endswith("between lift and CD") for word in words)


@pytest.mark.parametrize(("away", "words"), [(2e-16, "0 mm between"), (-2e-16, "0 mm between"), (2e-6, "0.002 mm"), (-2e-6, "cross")])
def test_a_gap_of_rounding_is_none(monkeypatch, away, words):
    def nearest(*given):
        return replace(nearest_places(*given), gap=away)

    monkeypatch.setattr("linkage.pictures.gap_marks.nearest_places", nearest)
    assert words in gap_mark(ThreePointHitch().at(S=0.1), ("lift", "CD"), ()).words


def test_without_planes_all_bodies_are_in_one_and_the_picture_says_so():
    motion = ThreePointHitch().sweep(5)
    figure = draw(motion, pose=4, clearance=True)
    texts = [text.get_text().replace("\n", " ") for text in figure.findobj(Text)]
    assert any("No Planes are declared: all bodies are taken in one plane, those that share a pin left out." in text for text in texts)
    assert any(str(text.get_gid()).startswith("gap ") for text in figure.findobj(Text))


class Stacked(ThreePointHitch):
    """A hitch with a cover on the lift arm that hides the lower link's end, drawn over it, and an edge of the implement."""

    cover = Outline([(-0.2, -1.5), (1.5, -1.5), (1.5, 0.3), (-0.2, 0.3)], on=("O", "B"))
    edge = Outline([(0.0, 0.0), (0.2, 0.0), (0.2, 0.1), (0.0, 0.1)], on=("E", "D"))


@for_all("machine", [ThreePointHitch, Stacked], slow=[Excavator])
def test_without_planes_what_is_built_together_is_left_out(machine):
    """No pair that is looked at shares a pin; what crosses in all poses is named and not looked at, and nothing else is."""
    motion = machine().at(**{name: stroke.start for name, stroke in machine().strokes.items()}, unreachable="nan")
    pairs, note = assumed_pairs(motion)
    corners = product(*((each.start, 0.5 * (each.start + each.end), each.end) for each in machine().strokes.values()))
    grid = machine().at(**dict(zip(machine().strokes, np.array(list(corners)).T, strict=True)), unreachable="nan")
    for one, other in pairs:
        assert np.nanmax(grid[gap(one, other)]) >= 0.0
        assert not {*body_of(motion.plan, one)} & {*body_of(motion.plan, other)}
    crossing = [each.strip(" .") for each in note.partition("strokes: ")[2].split(",")]
    told = {Excavator: [""], ThreePointHitch: ["CD and MK", "MK and OBC"], Stacked: ["CD and MK", "MK and cover", "cover and edge", ""]}
    assert crossing == told[machine]
    assert all(np.all(grid[gap(*each.split(" and "))] < 0.0) for each in crossing if each)


def body_of(plan, name):
    """Return the points of a body, or of the one that an outline is on."""
    outline = plan.of_kind(Outline).get(name)
    return whole_body(plan, " ".join(outline.carriers)) or outline.carriers if outline else shape_named(plan, name).points


class Folding(Mechanism):
    """Two cranks, one on the other: two strokes."""

    a, b = Stroke(0.0, 1.0), Stroke(0.2, 1.2)
    O = Ground(0.0, 0.0)
    A = Crank(O, OA=0.5, angle=a)
    B = Crank(A, AB=0.4, angle=b)


def test_poles_of_several_strokes_are_those_of_the_stroke_that_runs():
    """While a turns and the direction of AB is held, AB moves without turning: its pole is at infinity."""
    texts = " ".join(text.get_text().replace("\n", " ") for text in draw(Folding(), pole=True).findobj(Text))
    assert "Poles while a runs and the other strokes are held." in texts and "at infinity" in texts
    figure = draw(Folding(), dict(a=0.3, b=[0.2, 1.2]), pole="AB")
    ring = next(line for line in figure.findobj(Line2D) if line.get_gid() == "pole of AB")
    assert_allclose(np.ravel(ring.get_xydata()), 0.5 * np.array([np.cos(0.3), np.sin(0.3)]), atol=1e-12)
    assert any("about which a body turns" in text.get_text() for text in figure.findobj(Text))


def test_bodies_that_all_share_a_pin_have_no_gap_in_words():
    with pytest.raises(DefinitionError, match=r"Folding: clearance=True: all bodies share a pin or lie over each other; name two"):
        draw(Folding().at(a=0.3, b=0.5), clearance=True)


@shipped.over_machines()
def test_one_place_has_one_label_of_all_bodies_that_turn_about_it(machine):
    motion = pose_of(machine())
    bodies = [body for body, _ in asked_poles(motion, True)]
    marks = pole_marks(motion, 0, True, pole_rates(motion, 0, None)[0])
    there = [mark.at for mark in marks if np.isfinite(mark.at).all()]
    size = max(np.ptp([motion[name][axis] for name in motion.plan.points]) for axis in (0, 1))
    assert all(np.hypot(*(one - other)) > 1e-7 * size for one, other in combinations(there, 2))
    assert sorted(name for mark in marks for name in mark.name.removeprefix("pole of ").split(", ")) == sorted(bodies)


@pytest.mark.slow
def test_the_excavator_has_one_pole_and_one_label():
    figure = draw(Excavator(), pole=True)
    (text,) = [text.get_text() for text in figure.findobj(Text) if str(text.get_gid()).startswith("pole of ")]
    assert text.split(",") == ["pole of arm.J tool.H", " tool.HK", " arm.stick", "\ntool.bucket"]


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ("OBC", r"clearance='OBC': say clearance=True for what .*, or two bodies"),
        (("MK", "XY"), "Body 'XY' is unknown"),
    ],
)
def test_what_has_no_gap_is_refused(given, words):
    for asked in (ThreePointHitch().sweep(3), ThreePointHitch()):
        with pytest.raises(DefinitionError, match=words):
            draw(asked, clearance=given)
