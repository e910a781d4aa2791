"""The machines at work against their sources and against statics by hand, and through every door."""

import pickle
import tomllib
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from hydraulics import Cylinder
from linkage import LoadCase, LoadRule, Motion, Part, Planes, Target, axle_load, equations, pin_forces, standing, working_field
from linkage.files import load, to_toml
from linkage.statics import holding, work
from mechanisms.at_work.excavator import Excavator, HookExcavator
from mechanisms.at_work.forwarder import Forwarder
from mechanisms.at_work.front_loader import LoadedFrontLoader
from mechanisms.at_work.hoist_tipper import HoistTipper
from mechanisms.at_work.tail_lift import TailLift
from mechanisms.at_work.telehandler import BrakingTelehandler, Telehandler
from mechanisms.at_work.tipper import Tipper
from mechanisms.at_work.tractor import PloughTractor, SpreaderTractor
from mechanisms.at_work.wheel_loader import WheelLoader
from mechanisms.crane import Crane
from mechanisms.grapple import Grapple
from tests.for_all import for_all
from tests.machines import plane, test_excavator, test_tipper, test_wheel_loader
from tests.members import told_by

MACHINES = [
    Excavator, HookExcavator, HoistTipper, LoadedFrontLoader, PloughTractor, SpreaderTractor,
    TailLift, Telehandler, Tipper, WheelLoader,
]
JOINED = [*MACHINES, Forwarder]
DAILY = (HookExcavator, PloughTractor)
"""Parts, a shipped machine as a part, supports; two lines of oil, telescopes and groups are among the machines of other laws."""
ALL = for_all("machine", DAILY, slow=[machine for machine in MACHINES if machine not in DAILY])
PRINTED = {"boom": (-0.4737, 1.0923), "arm": (-0.5103, -2.5848), "bucket": (0.7839, -2.8659)}  # rad, at the shortest, at the longest


def middle(machine, shares=(0.3, 0.45, 0.6)):
    """Return strokes inside what a machine really runs."""
    over = machine().overs[0]
    ends = {name: np.atleast_1d(value) for name, value in over.strokes.items()}
    whole = {name: (stroke.start, stroke.end) for name, stroke in machine().strokes.items()}
    return {name: np.interp(shares, np.linspace(0.0, 1.0, len(np.atleast_1d(ends.get(name, each)))), np.atleast_1d(ends.get(name, each)))
            for name, each in whole.items()}  # fmt: skip


# -- every machine through every door ------------------------------------------------------------------------


@ALL
def test_no_verdict_fails(machine):
    assert [verdict for verdict in machine().verdicts() if verdict.startswith("FAIL")] == []


@ALL
def test_files_and_pickles_hold_it_whole(machine):
    design, strokes = machine(), middle(machine)
    again = load(to_toml(design))()
    assert [str(each) for each in again.overs] == [str(each) for each in design.overs]
    for other in (again, pickle.loads(pickle.dumps(design))):
        expected, found = design.at(**strokes), other.at(**strokes)
        for name in machine.plan.points:
            assert_array_equal(found[name], expected[name])
        for case in (None, *machine.plan.of_kind(LoadCase)):
            assert pin_forces(found, case=case).thrusts.keys() == pin_forces(expected, case=case).thrusts.keys()
            for name, thrust in pin_forces(expected, case=case).thrusts.items():
                assert_array_equal(pin_forces(found, case=case).thrusts[name], thrust)


@ALL
def test_a_part_is_read_in_its_own_names(machine):
    """Its points keep their distances, its cylinders their lengths and thrusts, and its own table is there."""
    motion = machine().at(**middle(machine))
    for name in machine.plan.of_kind(Part):
        part = motion.part(name)
        own = part.plan.of_kind(Cylinder)
        for each, cylinder in own.items():
            P, Q = cylinder.ends
            assert_allclose(np.hypot(*(part[Q] - part[P])), motion.distance(*machine.plan.members[f"{name}.{each}"].ends), rtol=1e-12)
            assert_allclose(cylinder.thrust(part), machine.plan.members[f"{name}.{each}"].thrust(motion), rtol=1e-12)
        assert isinstance(part, Motion)


@ALL
def test_forces_are_in_equilibrium_and_equations_are_there(machine):
    motion = machine().at(**middle(machine))
    for case in (None, *machine.plan.of_kind(LoadCase)):
        assert np.max(pin_forces(motion, case=case).residual) < 1e-9
    values = equations(machine()).values({name: each[1] for name, each in middle(machine).items()})
    solved = {pin for group in machine.plan.groups.values() for pin in group.pins}
    for name in set(machine.plan.moving) - solved:
        assert_allclose(values[name], motion[name][:, 1], atol=1e-12)


def test_all_of_them_are_installed():
    project = tomllib.loads(Path("pyproject.toml").read_text(encoding="utf-8"))["project"]
    installed = project["entry-points"]["hydrolinkage.machines"].values()
    assert {f"{machine.__module__}:{machine.__name__}" for machine in JOINED} <= set(installed)


# -- the excavator -------------------------------------------------------------------------------------------


def test_the_six_end_lengths_at_the_printed_angles():
    for part, (name, ends) in zip(("boom.up", "arm.fold", "tool.turn"), PRINTED.items(), strict=True):
        strokes = ("lift", "swing", "curl")
        driven = strokes[list(PRINTED).index(name)]
        for share, angle in zip((0.0, 1.0), ends, strict=True):
            at = {each: 0.5 * Excavator().strokes[each].end for each in strokes} | {driven: share * Excavator().strokes[driven].end}
            found = float(Excavator().at(**at)[part])
            assert abs(np.remainder(found - angle + np.pi, 2 * np.pi) - np.pi) < 1.1e-4


def test_places_and_thrusts_are_those_of_the_printed_model():
    hand = test_excavator
    for q in hand.POSES:
        strokes = {name: value[0] for name, value in zip(("lift", "swing", "curl"), hand.strokes([q]).values(), strict=True)}
        motion, p = Excavator().at(**strokes), hand.places(q)
        for part, names in (("boom", "DAE"), ("arm", "FGJL"), ("tool", "HKM")):
            for name in names:
                assert_allclose(motion[f"{part}.{name}"], p[name], atol=1e-12)
        dig = 10e3 * plane.turned((0.0, 1.0), sum(q))
        weights = [(name, (0.0, -mass * plane.G)) for name, mass in hand.MASS.items()]
        want = plane.balance(hand.places, q, [*weights, ("M", dig)], list(hand.RAMS.values()))
        found = [Excavator.plan.members[f"{part}.ram"].thrust(motion, case="digging") for part in ("boom", "arm", "tool")]
        assert_allclose(found, want, rtol=1e-8)


def without_bucket(q):
    """Return the places of boom and arm by two angles."""
    return {name: place for name, place in test_excavator.places([*q, 0.1]).items() if name not in ("H", "K", "M", "G3")}


def test_the_hook_stands_in_the_buckets_place():
    """The bucket's cylinder, link and stroke are gone; what hangs on the hook is carried by hand."""
    assert [*HookExcavator().strokes] == ["lift", "swing"]
    assert not any(name.startswith("tool.") for name in HookExcavator.plan.points)
    hand = test_excavator
    for q in hand.POSES[:, :2]:
        p = without_bucket(q)
        strokes = {"lift": plane.length(p["C"], p["D"]) - 0.905, "swing": plane.length(p["E"], p["F"]) - 1.046}
        loads = [("G1", (0.0, -227.343 * plane.G)), ("G2", (0.0, -130.123 * plane.G)), ("L", (0.0, -400.0 * plane.G))]
        want = plane.balance(without_bucket, q, loads, [("C", "D"), ("E", "F")])
        motion = HookExcavator().at(**strokes)
        assert_allclose([HookExcavator.plan.members[f"{part}.ram"].thrust(motion) for part in ("boom", "arm")], want, rtol=1e-8)


# -- the telehandler -----------------------------------------------------------------------------------------

O, A = np.array([-2.600, 1.550]), np.array([-2.098, 0.993])
DRAWN = {"forks.load": (0.70, 0.25, 3000.0), "forks.steel": (0.30, -0.10, 260.0)}


def telehandler(q):
    """Return every place by the boom's angle, how far it is drawn out, and the forks' angle against the boom."""
    up, out, tilt = q
    along = plane.turned((1.0, 0.0), up)
    found = {"O": O, "A": A, "B": O + 1.70 * along, "R": O + 0.80 * along, "T": O + (4.0 + out) * along, "Q": O + (3.3 + out) * along}
    found |= {"N": found["T"] + plane.turned((0.25, -0.50), up), "outer": O + 2.0 * along, "inner": O + (2.6 + out) * along}
    found["W"] = found["N"] + plane.turned((0.28 * np.cos(np.radians(92)), 0.28 * np.sin(np.radians(92))), up + tilt)
    return found | {name: found["N"] + plane.turned((x, y), up + tilt) for name, (x, y, _) in DRAWN.items()}


@pytest.mark.parametrize("q", [(0.1, 0.0, 0.0), (0.6, 1.2, -0.5), (0.9, 2.7, -0.9)])
def test_the_telehandlers_places_and_thrusts_by_hand(q):
    p = telehandler(np.array(q))
    strokes = {"lift": plane.length(p["A"], p["B"]) - 1.19, "extend": q[1], "tilt": plane.length(p["Q"], p["W"]) - 0.86}
    motion = Telehandler().at(**strokes)
    for name in "BTQN":
        assert_allclose(motion[name], p[name], atol=1e-12)
    assert_allclose(motion["forks.W"], p["W"], atol=1e-12)
    masses = {"outer": 700.0, "inner": 450.0} | {name: mass for name, (_, _, mass) in DRAWN.items()}
    loads = [(name, (0.0, -mass * plane.G)) for name, mass in masses.items()]
    want = plane.balance(telehandler, q, loads, [("A", "B"), ("R", "T"), ("Q", "W")])
    found = [Telehandler.plan.members[name].thrust(motion) for name in ("ram", "push", "forks.ram")]
    assert_allclose(found, want, rtol=1e-8)


def test_the_forks_stay_level_where_the_telehandler_stacks():
    over = next(each for each in Telehandler().overs if each.name == "stacking")
    motion = Telehandler().at(**{name: np.asarray(value) for name, value in over.strokes.items()})
    assert np.max(np.abs(motion.y("forks.X") - motion.y("forks.F"))) < 0.02


# -- the tippers and the loader: the same linkages by hand ----------------------------------------------------


def test_the_hoist_tippers_thrust_and_pressure_by_hand():
    S = np.array([0.0, 1.0, 2.0, 3.0, 4.2])
    motion, hinge = HoistTipper().at(S=S), np.hypot(5.70, 1.15)
    frame, foot = np.hypot(5.60, 0.35), np.arctan2(-0.35, 5.60)
    at_hinge = np.arccos((frame**2 + hinge**2 - (1.5 + S) ** 2) / (2 * frame * hinge))
    lever = frame * hinge * np.sin(at_hinge) / (1.5 + S)
    thrust = 19e3 * 9.80665 * 3.10 * np.cos(at_hinge + foot + np.radians(9.4)) / lever
    assert_allclose(HoistTipper.hoist.thrust(motion), thrust, rtol=1e-9)
    bores = np.array([0.149, 0.149, 0.129, 0.110, 0.091])
    assert_allclose(HoistTipper.line.holding(motion).working, thrust / (np.pi / 4 * bores**2), rtol=1e-9)


def test_the_tippers_places_and_thrust_by_hand():
    opened = [test_tipper.opened(tip) - 1.790 for tip in test_tipper.TIPS]
    motion = Tipper().at(S=opened)
    for k, tip in enumerate(test_tipper.TIPS):
        for name in "CEBG":
            assert_allclose(motion[name][:, k], test_tipper.places([tip])[name], atol=1e-10)
    assert_allclose(Tipper.lift.thrust(motion), [test_tipper.thrust(tip) for tip in test_tipper.TIPS], rtol=1e-9)


def test_the_loaders_places_and_thrusts_by_hand():
    hand = test_wheel_loader
    strokes = dict(zip(("lift", "tilt"), hand.strokes().values(), strict=True))
    motion = WheelLoader().at(**strokes)
    for k, q in enumerate(hand.POSES):
        for name in "DPNUVWZQ":
            assert_allclose(motion[name][:, k], hand.places(q)[name], atol=1e-11)

    def places(q):
        found = hand.places(q)
        return found | {
            "G1": plane.on(found["A"], found["N"], 1.44, 0.17),
            "G3": plane.on(found["N"], found["Z"], 0.44, 0.24),
        }

    want = [plane.balance(places, q, hand.CASES[None], list(hand.RAMS.values())) for q in hand.POSES]
    found = np.stack([WheelLoader.lift_rams.thrust(motion), WheelLoader.tilt_ram.thrust(motion)], axis=1)
    assert_allclose(found, want, rtol=1e-9)


# -- the forwarder: two shipped machines joined --------------------------------------------------------------

HELD = {"phi": 0.8, "psi": 2.0, "t": 0.5, "swing": 0.0, "theta": -0.5, "twin": -0.5}


@pytest.mark.slow
def test_a_plumb_grapple_pushes_as_it_does_alone_and_moves_no_head():
    """The pushes of both levers and of the stem are in balance in the head: it hangs plumb, and the crane carries its load alone."""
    motion, forces = Forwarder().at(**HELD), pin_forces(Forwarder().at(**HELD))
    alone = pin_forces(Grapple().at(theta=-0.5)).thrusts["lift"]
    assert_allclose([forces.thrusts["right.lift"], forces.thrusts["left.lift"]], [alone, alone], rtol=1e-10)
    crane = pin_forces(Crane().at(phi=0.8, psi=2.0, t=0.5))
    for name, thrust in crane.thrusts.items():
        assert_allclose(forces.thrusts[f"crane.{name}"], thrust, rtol=1e-9)
    assert abs(float(forces.drives["swing"])) < 1e-6
    assert float(np.max(forces.residual)) < 1e-12
    for name in "OACE":
        right, left = motion[f"right.{name}"] - motion["crane.T"], motion[f"left.{name}"] - motion["crane.T"]
        assert_allclose(left, right * [-1.0, 1.0], atol=1e-12)


def test_what_five_cylinders_hold_is_worked_out_once_for_all_of_them(monkeypatch):
    """Levers, loads and what the strokes need, of one motion: each thrust asked first is that of a motion on which all were asked."""
    counts = {"levers_of": 0, "applied_loads": 0}

    def counted(room, name):
        made = getattr(room, name)

        def count(*given):
            counts[name] += 1
            return made(*given)

        monkeypatch.setattr(room, name, count)

    motion, cylinders = Forwarder().at(**HELD), Forwarder.plan.of_kind(Cylinder)
    alone = {name: each.thrust(Forwarder().at(**HELD)) for name, each in cylinders.items()}
    counted(holding, "levers_of")
    counted(work, "applied_loads")
    together = {name: each.thrust(motion) for name, each in cylinders.items()}
    assert together == alone and counts == {"levers_of": 1, "applied_loads": 1}
    empty = {name: float(each.thrust(motion, case="empty")) for name, each in cylinders.items()}
    assert counts == {"levers_of": 1, "applied_loads": 2} and abs(empty["right.lift"]) < abs(together["right.lift"])


def test_the_levers_of_the_forwarder_are_read_as_the_grapple_is():
    """Its own table, in its own axes, wherever the crane holds it and however the head swings."""
    motion, alone = Forwarder().at(**HELD | {"swing": 0.2}), Grapple().at(theta=-0.5)
    for name in ("right", "left"):
        part = motion.part(name)
        for point in Grapple.plan.points:
            assert_allclose(np.ravel(part[point]), np.ravel(alone[point]), atol=1e-12)
        for output in ("D", "EC", "room", "M_1", "OA"):
            assert_allclose(part[output], alone[output], rtol=1e-11)


# -- the front loader ----------------------------------------------------------------------------------------


def test_the_front_loaders_thrusts_are_the_slope_of_its_potential_energy():
    """What both pairs of cylinders carry, out of heights alone; the parallelograms keep the bucket's angle while it is lifted."""
    design, at = LoadedFrontLoader(), {"lift": 0.25, "tilt": 0.12}

    def energy(lift, tilt):
        motion = design.at(lift=lift, tilt=tilt)
        p = {name: np.ravel(motion[name]) for name in "OBN"}
        bucket = 160.0 * plane.on(p["B"], p["N"], 0.35, 0.15) + 800.0 * plane.on(p["B"], p["N"], 0.45, 0.25)
        return plane.G * (180.0 * plane.on(p["O"], p["B"], 1.3, 0.1) + bucket)[1]

    motion, step = design.at(**at), 1e-3
    for name, ram in (("lift", LoadedFrontLoader.rams), ("tilt", LoadedFrontLoader.tilt_rams)):
        ahead, behind = (energy(**at | {name: at[name] + sign * step}) for sign in (1.0, -1.0))
        assert_allclose(ram.thrust(motion), (ahead - behind) / (2.0 * step), rtol=1e-4)
    assert np.ptp(design.at(lift=[0.0, 0.3, 0.6], tilt=0.1)["attitude"]) < 1e-12


# -- on tracks and axles -------------------------------------------------------------------------------------

STANDING = {  # kg and m: each mass along and to the left of two points of its body, or at a place of the frame; where front and rear stand
    HookExcavator: (
        [(227.343, "boom.B", "boom.A", 1.025, 0.384), (130.123, "boom.A", "arm.L", 0.225, 0.227)], (2300.0, -0.90), (0.02, -1.52),
    ),
    Telehandler: (
        [(700.0, "O", "B", 2.0, 0.0), (450.0, "Q", "T", -0.7, 0.0), (260.0, "forks.F", "forks.X", 0.20, 0.15)],
        (6100.0, -1.75), (0.0, -2.85),
    ),
    WheelLoader: ([(900.0, "A", "N", 1.44, 0.17), (700.0, "N", "Z", 0.44, 0.24)], (8400.0, -1.55), (0.35, -2.55)),
}  # fmt: skip
LOADS = {HookExcavator: ("arm.L", "tool.load", 400.0), Telehandler: ("forks.G", "forks.load", 3000.0), WheelLoader: ("Q", "load", 3000.0)}
VEHICLES = pytest.mark.parametrize("machine", STANDING, ids=lambda machine: machine.__name__)


def own_moment(machine, motion, about):
    """Return the moment of all weights but the load about a place of the ground [Nm], by hand, and the sum of the weights [N]."""
    masses, (frame, x), _ = STANDING[machine]
    place = {name: np.moveaxis(np.broadcast_to(motion[name], (2, *motion.shape)), 0, -1) for each in masses for name in each[1:3]}
    moment, total = frame * (about - x), frame
    for mass, P, Q, along, left in masses:
        reach = place[Q] - place[P]
        e = reach / np.linalg.norm(reach, axis=-1, keepdims=True)
        moment = moment + mass * (about - (place[P][..., 0] + along * e[..., 0] - left * e[..., 1]))
        total += mass
    return plane.G * moment, plane.G * total


@VEHICLES
def test_axle_loads_are_the_moments_about_the_axles(machine):
    motion, (_, _, (front, rear)) = machine().at(**middle(machine)), STANDING[machine]
    point, _, mass = LOADS[machine]
    found, weight = standing(motion).reactions, mass * plane.G
    about_front, total = own_moment(machine, motion, front)
    on_rear = (about_front + weight * (front - motion.x(point))) / (front - rear)
    assert_allclose(found["rear"], on_rear, rtol=1e-11)
    assert_allclose(found["front"], total + weight - on_rear, rtol=1e-11)


@VEHICLES
def test_where_tipping_limits_the_chart_the_rear_axle_carries_nothing(machine):
    """In every such cell the load is the share of the rule of what balances the machine over its front axle."""
    point, load, _ = LOADS[machine]
    keep = {Telehandler: [Target("level", 0.0)], WheelLoader: []}.get(machine, [])
    heights = np.linspace(1.0, 3.0, 5) if machine is not HookExcavator else np.linspace(-1.0, 1.0, 5)
    field = working_field(
        machine(), point, x=np.linspace(1.0, 3.0, 9), y=heights, keep=keep, rule=LoadRule("works rule", tipping=0.6), without=[load]
    )
    tips, (_, _, (front, _)) = field.limiter == "tipping", STANDING[machine]
    assert np.count_nonzero(tips) >= 5
    strokes = {name: values[tips] for name, values in field.strokes.items()}
    motion = machine().at(**strokes)
    moment, _ = own_moment(machine, motion, front)
    assert_allclose(field.load[tips], 0.6 * moment / (motion.x(point) - front), rtol=1e-8)


def test_the_loaders_bucket_stays_clear_of_lever_and_wheel():
    """The least clearance is that of lever and bucket; where the bucket is curled farther its shell comes nearer, by corners and edges."""
    design = WheelLoader()
    found = next(each for each in told_by(design, *design.plan.of_kind(Planes)) if "clearance" in each)
    assert found.ok and "PUV and shell" in str(found)
    motion = design.at(**found.answer.strokes)
    N, Z = np.ravel(motion["N"]), np.ravel(motion["Z"])
    corners = [plane.on(N, Z, *each) for each in ((-0.05, -0.06), (1.16, 0.0), (0.78, 0.40), (0.40, 0.85), (0.0, 0.80), (-0.12, 0.30))]
    lever = [np.ravel(motion[name]) for name in "PUV"]

    def apart(A, B, C):
        share = np.clip((C - A) @ (B - A) / ((B - A) @ (B - A)), 0.0, 1.0)
        return np.hypot(*(C - A - share * (B - A)))

    pairs = [(corners, lever), (lever, corners)]
    least = min(apart(side[k - 1], side[k], C) for side, others in pairs for k in range(len(side)) for C in others)
    assert_allclose(found.answer.value, least - 0.09, atol=1e-9)


# -- the tractor ---------------------------------------------------------------------------------------------

MASSES = {  # kg, along FK and to its left in m, as each tool's docstring and file say
    SpreaderTractor: [(380.0, 0.30, -0.55), (1500.0, 0.45, -0.65)],
    PloughTractor: [(1150.0, 0.15, -1.20)],
}
DRAUGHT = np.array([24e3, -3e3])  # N, along the plough and up its mast
TRACTORS = pytest.mark.parametrize("machine", MASSES, ids=lambda machine: machine.__name__)


def acting_on(machine, motion, case):
    """Return the forces on the tool and where they act, by hand from the places of its mast: (place, force) each."""
    F, K = np.ravel(motion["hitch.F"]), np.ravel(motion["hitch.K"])
    slope = np.radians(-12.0) if case == "uphill" else 0.0
    down = plane.G * np.array([-np.sin(slope), -np.cos(slope)])
    masses = MASSES[machine][: 1 if case == "bare" else None]
    loads = [(plane.on(F, K, along, left), mass * down) for mass, along, left in masses]
    if machine is PloughTractor and case != "bare":
        up = (K - F) / np.hypot(*(K - F))
        loads.append((plane.on(F, K, -0.48, -1.50), DRAUGHT[0] * np.array([up[1], -up[0]]) + DRAUGHT[1] * up))
    return loads, down


@TRACTORS
@for_all("case", ["plain", "uphill", "bare"])
def test_the_tractors_axle_loads_are_the_moments_about_its_wheels(machine, case):
    for S in (0.05, 0.15, 0.25):
        motion = machine().at(S=S)
        loads, down = acting_on(machine, motion, case)
        loads.append((np.array([-1.1, 1.1]), 8000.0 * down))
        about_rear = sum(place[0] * force[1] - place[1] * force[0] for place, force in loads)
        front = about_rear / 2.75  # the front axle stands 2.75 m before the rear one and pushes up
        found = standing(motion, case=None if case == "plain" else case)
        assert_allclose(found.reactions["front"], front, rtol=1e-12)
        assert_allclose(found.reactions["rear"], -front - sum(force[1] for _, force in loads), rtol=1e-12)
        assert_allclose(found.along, -sum(force[0] for _, force in loads), rtol=1e-12, atol=1e-9)


@TRACTORS
def test_the_hitchs_thrust_is_the_work_of_what_acts_on_the_tool(machine):
    """By small steps of the stroke: the cylinders do the work that the loads take, whatever carries these in between."""
    step = 1e-4
    for case in ("plain", "uphill", "bare"):
        before, at, after = (acting_on(machine, machine().at(S=0.12 + way), case)[0] for way in (-step, 0.0, step))
        work = sum(force @ (ahead - behind) for (_, force), (behind, _), (ahead, _) in zip(at, before, after, strict=True))
        thrust = machine.plan.members["hitch.lift"].thrust(machine().at(S=0.12), case=None if case == "plain" else case)
        assert_allclose(thrust, -work / (2.0 * step), rtol=1e-6)


def test_tractor_and_hitch_know_one_figure():
    """The tractor's mass, its place and the wheelbase are the hitch's own dimensions: what is set there moves the axle loads."""
    heavy = SpreaderTractor(**{"hitch.vehicle_mass": 9000.0}).at(S=0.1)
    plain = SpreaderTractor().at(S=0.1)
    for axle, share in (("front", 1.1 / 2.75), ("rear", 1.65 / 2.75)):
        assert_allclose(standing(heavy).reactions[axle] - standing(plain).reactions[axle], 1000.0 * plane.G * share, rtol=1e-10)


def test_the_tail_lifts_pilot_pressure_by_hand():
    motion, mass = TailLift().sweep(S=4, tilt=0.0), 1680.0
    assert np.abs(motion["level"]).max() < 1e-12  # a parallelogram
    thrust = mass * 9.80665 * motion.ratio("P", wrt="S")[1]  # the platform only translates
    assert_allclose(TailLift.lift.thrust(motion, case="full"), thrust, rtol=1e-9)
    piston, annulus = (2 * np.pi / 4 * area for area in (0.063**2, 0.063**2 - 0.036**2))
    expected = np.linalg.solve([[1.0, 3.0], [piston, -annulus]], np.stack([np.full(4, 140e5), thrust]))
    assert_allclose(TailLift.valve.pilot_pressure(motion), expected[1], rtol=1e-9)
    assert_allclose(TailLift.lifting.pressure(motion, case="parked"), thrust / piston, rtol=1e-9)


def test_braking_tips_the_telehandler_by_the_change_of_its_momentum():
    """Both axles carry the weights and what the load's, the carriage's and the tubes' centres gain upwards, by differences of places."""
    motion = BrakingTelehandler().sweep(401, over="cycle")
    step, braking = motion.time[1], slice(377, 397)

    def centre(P, Q, along, across):
        d = motion[Q] - motion[P]
        e = d / np.hypot(*d)
        return (motion[P] + along * e + across * np.array([-e[1], e[0]]))[1]

    heights = {
        3000.0: motion["forks.G"][1], 260.0: centre("forks.F", "forks.X", 0.20, 0.15),
        700.0: centre("O", "B", 2.0, 0.0), 450.0: centre("Q", "T", -0.7, 0.0),
    }  # fmt: skip
    lifted = sum(mass * np.diff(height, 2) for mass, height in heights.items()) / step**2
    loads = sum(motion[axle_load(name, case="plain")] for name in ("front", "rear"))
    wanted = (6100.0 + sum(heights)) * 9.80665 + lifted
    assert np.all(motion.accelerations["lift"][braking] == 0.25) and lifted[376:396].min() > 1000.0  # N, of 104 kN of weight
    assert_allclose(loads[braking], wanted[376:396], rtol=1e-4)
