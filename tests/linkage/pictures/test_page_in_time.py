"""A live page over a path in time: strokes, rates, forces and verdicts at each instant are Python's; what is not followed is counted."""

import json
import subprocess

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import LiftCircuit, pressure
from linkage import Course, Over, Weight, ramp
from linkage.motion import live_text
from linkage.motion.motion_verdicts import over_pose
from linkage.pictures.force_arrows import one_pose
from linkage.pictures.page_data import PageRequests, page_data
from linkage.pictures.page_file import page_part
from linkage.pictures.page_judge import PHASES, course_data
from linkage.reports import request_in_case
from linkage.units import bar
from mechanisms.at_work.excavator import DiggingExcavator
from mechanisms.at_work.forwarder import LoadingForwarder
from mechanisms.at_work.telehandler import BrakingTelehandler
from tests.for_all import for_all
from tests.linkage.motion.in_node import NEEDED
from tests.linkage.pictures.test_in_seconds import LoadedLever

pytestmark = NEEDED
RUNNER = """
const fs=require('fs'),job=JSON.parse(fs.readFileSync(0,'utf8'));
const {engine,judging,atInstant,ratesAt}=new Function(job.text+';return {engine,judging,atInstant,ratesAt}')();
const judge=judging(engine,job.judge),over=job.judge.overs[job.over],shown=x=>typeof x==='number'&&!Number.isFinite(x)?String(x):x;
const found=job.times.map((t,i)=>{
  const states=atInstant(over,t),at=states.map(([v])=>v),pose=engine.sweep(job.design,at.map(v=>[v]),ratesAt(over,[t]));
  pose.values.push(...(job.judge.delivered||[]).map(list=>[list[Math.round(i*(list.length-1)/(job.times.length-1))]]));
  const still=engine.sweep(job.design,at.map(v=>[v]));
  return {states,values:pose.values.map(([v])=>v),here:judge.here(at,pose,job.over),apart:judge.here(at,still,-1)};
});
process.stdout.write(JSON.stringify(found,(_,x)=>shown(x)));
"""


class Pumped(LoadedLever):
    """Without friction, on a pump; a box beside the path in time, where nothing but the machine's own loads acts."""

    rub = None
    pump = LiftCircuit("lift", pressure=90 * bar)
    box = Over(S=(0.31, 0.49), cases=["plain"])


class Sudden(Pumped):
    """Its rate jumps, so that inertia is left out."""

    rise = Over.path(S=ramp(0.32, 0.4, speed=0.05).then(ramp(0.4, 0.48, speed=0.1)), cases=["full"])


class TwoRates(LoadedLever):
    """A load that counts in the case alone, in which the load case of the path differs from what the box has."""

    rub = None
    hook = Weight("B", mass=10.0)


def played(machine, count=5):
    """Return the page's requests and data, what it says at instants of its path in time, the motion there and the situation's number."""
    requests = PageRequests(machine, 9)
    live = live_text(machine.plan, requests.by_name, name="engine")
    data = page_data(requests, live)
    places = requests.questions.judge.places
    over = next(k for k, place in enumerate(places) if place.instants is not None)
    motion = places[over].timed(places[over].instants.shares(np.linspace(0.0, 1.0, count)), "nan")
    text = "\n".join((live.text, page_part("judge.js"), page_part("judge_time.js")))
    job = {"text": text, "judge": data["judge"], "over": over, "times": motion.time.tolist()}
    job["design"] = [float(machine.dimensions[name]) for name in live.dimensions]
    run = subprocess.run(["node", "-e", RUNNER], input=json.dumps(job), capture_output=True, text=True)
    assert not run.returncode, run.stderr[-2000:]
    return requests, data, json.loads(run.stdout), motion, requests.situation_of[over]


def row_in(row, situation):
    return row[situation] if isinstance(row, list) else row


def numbers(found, row):
    return np.array([float(each["values"][row]) for each in found])


def check_forces(machine, least):
    """Compare all that the page shows over its path in time with Python to 1e-9 of the largest; return how many columns it follows."""
    requests, data, found, motion, k = played(machine)
    strokes = np.array([each["states"] for each in found], float).transpose(2, 1, 0)
    for own, mine in zip(strokes, (motion.strokes, motion.rates, motion.accelerations), strict=True):
        assert_allclose(own, np.array([*mine.values()]), rtol=1e-12, atol=1e-13)
    case, count, alike = requests.situations[k].case, 0, [each for each, of in enumerate(data["timeOf"]) if of == data["timeOf"][k]]
    assert alike == [each for each, one in enumerate(requests.situations) if one.motion is requests.situations[k].motion]
    for (name, (_, request, _)), given in zip(requests.columns.items(), data["columns"], strict=True):
        row = row_in(given[2], k)
        if row is None or row < 0:
            values = given[4][k]
            assert len(values) == requests.count and any(each is not None for each in values), name
            continue
        own, count = motion[request_in_case(request, case)], count + 1
        assert_allclose(numbers(found, row), own, rtol=0, atol=1e-9 * max(np.nanmax(np.abs(own)), 1e-9), err_msg=name)
    for arrow, own_arrow in zip(data["arrows"], requests.arrows, strict=False):
        for axis, asked in own_arrow.parts.items():
            for other in alike if len(data["arrows"]) == len(requests.arrows) else ():
                if (row := row_in(arrow[axis], other)) is not None:
                    own = motion[request_in_case(asked, requests.situations[other].case)]
                    assert_allclose(numbers(found, row), own, rtol=0, atol=1e-9 * max(np.nanmax(np.abs(own)), 1.0), err_msg=own_arrow.point)
    assert count >= least, count
    return requests, data, found, motion, k


@for_all("kind, least", [
    (Pumped, 8), (LoadedLever, 4), pytest.param(Sudden, 8, marks=pytest.mark.slow), pytest.param(TwoRates, 7, marks=pytest.mark.slow),
    pytest.param(DiggingExcavator, 40, marks=pytest.mark.slow), pytest.param(BrakingTelehandler, 30, marks=pytest.mark.slow),
    pytest.param(LoadingForwarder, 100, marks=pytest.mark.slow),
])  # fmt: skip
def test_a_page_shows_the_forces_of_each_instant(kind, least):
    check_forces(kind(), least)


def test_barrels_arrows_and_verdicts_are_of_what_runs():
    requests, data, found, motion, k = check_forces(Pumped(), 8)
    other = requests.situation_of[1]
    assert other != k and len(requests.situations) == 3  # as it runs; at rest in either load case
    (lift,) = data["cylinders"]
    own = motion[pressure("lift", case="full")]
    assert_allclose(numbers(found, lift["pressure"][k]), own, rtol=1e-9)
    still = motion.moved(motion.strokes)[pressure("lift")]
    assert_allclose(numbers(found, lift["pressure"][other]), still, rtol=1e-9)
    arrow = next(each for each in data["arrows"] if each.get("load") is None)
    assert arrow["x"][k] != arrow["x"][other]
    for pose in (1, 3):
        said = dict(zip([each["rule"] for each in data["judge"]["questions"]], found[pose]["here"]["found"], strict=True))
        (asked,) = next(constraints for rule, constraints, _ in requests.questions.asked if rule == "lifting")
        (answer,) = Pumped().answers([asked], over=over_pose(one_pose(motion, pose), ["full"]))
        assert float(said["lifting"]["value"]) == pytest.approx(float(answer.value), rel=1e-6), pose
        assert not any(each.get("unknown") for each in said.values())


@pytest.mark.slow
def test_what_a_page_does_not_follow_is_not_kept():
    for kind in (Pumped, LoadedLever):
        _, data, found, _, _ = played(kind())
        timed = [any(piece.get("timed") for leaf in each["leaves"] for piece in leaf["pieces"]) for each in data["judge"]["questions"]]
        assert any(timed)
        for each in found:
            assert each["here"]["covered"] and not any(one.get("unknown") for one in each["here"]["found"])
            apart = each["apart"]
            alone = [over for over in data["judge"]["overs"] if "courses" not in over]
            assert apart["covered"] == bool(alone)  # a path in time is looked at while it runs
            unknown = [bool(one.get("unknown")) for one in apart["found"]]
            assert unknown == (timed if not alone else [False] * len(timed))


def test_a_long_course_goes_to_a_page_as_cubics():
    times = np.linspace(0.0, 30.0, 1001)
    course = Course(times, 0.4 + 0.05 * np.sin(times))

    class Long(LoadedLever):
        rise = Over.path(S=course, cases=["full"])

    place = Long().judge().places[0]
    data = course_data(place.instants)
    breaks, rows, _ = data["courses"][0]
    assert len(rows) == PHASES and data["time"] == [0.0, 30.0]
    for order, close in ((0, 1e-6), (1, 1e-4)):
        at = 17.3
        i = int(np.searchsorted(breaks, at) - 1)
        assert np.polyval(np.polyder(np.array(rows[i][::-1]), order), at - breaks[i]) == pytest.approx(course(at, order), abs=close)
