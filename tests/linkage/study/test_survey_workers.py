"""Surveys by other processes: pools and a dask cluster give what one process gives, and lose nothing when a worker is killed."""

import functools
import multiprocessing
import os
import pickle
import subprocess
import sys
from concurrent.futures import BrokenExecutor, Future, ProcessPoolExecutor, ThreadPoolExecutor
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest

from linkage import LinkageError, StudyError
from linkage.plan.plan import RECENT, REGISTRY
from linkage.study import survey
from mechanisms.three_point_hitch import ThreePointHitch
from tests.for_all import first_daily
from tests.linkage.study.survey_measures import deadly, failing, far_points, group_designs, hitch_designs, logged, travel
from tests.linkage.study.test_survey import read, same

BATCHES = import_module("linkage.study.survey")  # the module, whose function goes by its name

ROOT = Path(__file__).parents[3]
FORKING = pytest.mark.filterwarnings("ignore:.*use of fork.*:DeprecationWarning")  # Python 3.12 warns of threads beside a fork


@pytest.fixture
def small(monkeypatch):
    """Batches of one piece: many of them from few designs."""
    monkeypatch.setattr(BATCHES, "AIM", 1e-9)
    monkeypatch.setattr(BATCHES, "LEAST", 1e-9)


@pytest.fixture(scope="module")
def spawned():
    with ProcessPoolExecutor(2, multiprocessing.get_context("spawn")) as pool:
        yield pool


@pytest.fixture(scope="module")
def client(request, tmp_path_factory):
    """A thread of dask, or a process where one is asked for. Its linear algebra has this one's threads: NumPy 1 rounds by their number."""
    dask, distributed = pytest.importorskip("dask"), pytest.importorskip("distributed")
    options = {"n_workers": 1, "threads_per_worker": 1, "dashboard_address": None, "silence_logs": 50}
    options["processes"] = getattr(request, "param", False)
    folder = tmp_path_factory.mktemp("dask")
    alike = dask.config.set({"distributed.nanny.pre-spawn-environ": {}})
    with alike, distributed.LocalCluster(local_directory=str(folder), **options) as cluster, distributed.Client(cluster) as client:
        yield client


PROCESS = pytest.mark.parametrize("client", [True], indirect=True, ids=["process"])

# -- the same to the last bit -------------------------------------------------------------------------------

GIVEN = [(hitch_designs(640), travel), (group_designs(256), far_points)]
STUDIES, FIRST = (first_daily(count, ("given", "measure"), GIVEN, ids=["hitch", "group"]) for count in (2, 1))


@pytest.fixture(scope="module")
def wanted():
    """What one process gives, worked out once."""
    return functools.cache(lambda measure: survey(*next(given for given, each in GIVEN if each is measure), measure))


@STUDIES
def test_threads_give_what_one_process_gives(small, wanted, given, measure):
    with ThreadPoolExecutor(3) as pool:
        same(survey(*given, measure, executor=pool), wanted(measure))


@FORKING
@FIRST
def test_forked_processes_give_what_one_process_gives(small, wanted, given, measure):
    with ProcessPoolExecutor(2, multiprocessing.get_context("fork")) as pool:
        same(survey(*given, measure, executor=pool), wanted(measure))


@FIRST
def test_spawned_processes_give_what_one_process_gives(small, wanted, spawned, given, measure):
    """They hash names with a seed of their own, and have done no work before."""
    same(survey(*given, measure, executor=spawned), wanted(measure))


@pytest.mark.slow
@pytest.mark.parametrize("client", [False, pytest.param(True, marks=pytest.mark.slow)], indirect=True, ids=["thread", "process"])
@FIRST
def test_dask_gives_what_one_process_gives(small, wanted, client, given, measure):
    same(survey(*given, measure, executor=client.get_executor()), wanted(measure))
    same(survey(*given, measure, executor=client), wanted(measure))


def test_several_batches_are_under_way_at_a_time(small, spawned):
    """Few for each worker: neither one by one nor all at once."""
    counted = Counted(spawned)
    survey(*hitch_designs(64 * 16), travel, executor=counted)
    assert counted.most in range(2, 12)


class Counted:
    """An executor that counts what is under way."""

    def __init__(self, pool):
        self.pool, self.now, self.most = pool, [], 0

    def submit(self, *call):
        future = self.pool.submit(*call)
        self.now = [each for each in self.now if not each.done()] + [future]
        self.most = max(self.most, len(self.now))
        return future


# -- what is sent -------------------------------------------------------------------------------------------


def test_a_mechanism_is_sent_without_its_program():
    hitch = ThreePointHitch(OB=0.31)
    fresh = len(pickle.dumps(hitch))
    hitch.sweep(11).ratio("G")
    sent = pickle.dumps(hitch)
    assert len(sent) == fresh < 2000
    arrived = pickle.loads(sent)
    assert type(arrived) is ThreePointHitch and arrived.dimensions == hitch.dimensions


def test_a_plan_that_arrives_again_is_the_same_with_its_kernels():
    sent = pickle.dumps(ThreePointHitch.plan)
    assert pickle.loads(sent) is ThreePointHitch.plan
    plan = type("Other", (ThreePointHitch,), {}).plan
    plan.kernel(plan.moving)
    sent = pickle.dumps(plan)
    REGISTRY.pop(plan.key)
    arrived = pickle.loads(sent)
    assert arrived is not plan and arrived is pickle.loads(sent) and arrived in RECENT
    assert not arrived._kernels and "trace" not in vars(arrived) and str(arrived) == str(plan)
    inputs = dict(ThreePointHitch().dimensions) | {"S": np.linspace(0.0, 0.25, 30)}
    np.testing.assert_array_equal(arrived.kernel(("G",))(inputs).values, plan.kernel(("G",))(inputs).values)


@pytest.mark.slow
def test_functions_by_value_are_for_dask_and_not_for_a_pool(client, spawned):
    hitch, over = hitch_designs(200)
    factor = 2.0
    found = survey(hitch, over, lambda machine: {"OB": factor * machine["OB"]}, executor=client.get_executor())
    np.testing.assert_array_equal(found["OB"], 2.0 * over["OB"])
    with pytest.raises(StudyError, match=r"0 of 200 designs .* cannot be sent to a worker: put both at the top of a module") as caught:
        survey(hitch, over, lambda machine: {"OB": machine["OB"]}, executor=spawned)
    assert isinstance(caught.value.__cause__, (AttributeError, pickle.PicklingError))


SCRIPT = """
import sys
import numpy as np
from distributed import Client
from linkage import *
from linkage.study import survey
from mechanisms.three_point_hitch import ThreePointHitch

class Rocker(Mechanism):
    S = Stroke(0.0, 0.25)
    A, O = Ground(0.20, 0.55), Ground(0.30, 1.15)
    B = Dyad(A, O, AB=0.50 + S, OB=0.30, side=RIGHT)
    turn = angle(O, B)

class Longer(ThreePointHitch):
    S = Stroke(0.0, 0.20)

def measure(machine):
    (turn,) = machine.evaluate(["turn" if "turn" in machine.plan.members else "tilt"], S=np.linspace(0.0, 0.2, 11))
    return {"turn": np.ptp(turn, axis=-1)}

if __name__ == "__main__":
    for machine in (Rocker(), Longer()):
        machine.sweep(11)
        over = {"OB": np.linspace(0.29, 0.31, 500)}
        with Client(sys.argv[1]) as client:
            found = survey(machine, over, measure, executor=client.get_executor())
        here = survey(machine, over, measure)
        assert type(machine).__module__ == "__main__" and len(found.batches) > 1
        print(np.array_equal(found["turn"], here["turn"]), np.isfinite(here["turn"]).all())
"""


@PROCESS
@pytest.mark.slow
def test_classes_of_a_script_are_sent_by_dask(client, tmp_path):
    script = tmp_path / "script.py"
    script.write_text(SCRIPT)
    run = [sys.executable, "-W", "error", str(script), client.scheduler_info()["address"]]
    done = subprocess.run(run, cwd=ROOT, env=os.environ | {"PYTHONPATH": str(ROOT)}, capture_output=True, text=True, timeout=120)
    assert (done.stdout, done.returncode) == ("True True\nTrue True\n", 0), done.stderr


# -- what goes wrong ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("pool", ["spawned", pytest.param("client", marks=pytest.mark.slow)])
def test_failure_in_a_worker_names_its_designs(small, pool, request, tmp_path):
    (hitch, over), executor = hitch_designs(640), request.getfixturevalue(pool)
    measure = functools.partial(failing, victim=over["OB"][333])
    with pytest.raises(StudyError, match=r"measure failed at designs 320 to 383: AssemblyError: .*cannot be assembled") as caught:
        survey(hitch, over, measure, executor=executor.get_executor() if pool == "client" else executor, folder=tmp_path)
    assert caught.value.designs == (320, 383)
    kept = sum(int(path.name.split("-")[2]) - int(path.name.split("-")[1]) for path in tmp_path.glob("designs-*.npy"))
    assert 0 < kept < 640 and f"{kept} of 640 designs are done and kept in" in caught.value.__notes__[-1]


@pytest.mark.slow
@FORKING
def test_pool_whose_worker_was_killed_tells_and_another_goes_on(small, tmp_path):
    hitch, over = hitch_designs(1280)
    log, run = tmp_path / "log", tmp_path / "run"
    measure = functools.partial(deadly, log=log, victim=over["OB"][700])
    fork = multiprocessing.get_context("fork")
    with ProcessPoolExecutor(2, fork) as pool, pytest.raises(StudyError, match=r"of 1280 designs are .* kept in .*goes on") as caught:
        survey(hitch, over, measure, executor=pool, folder=run)
    assert isinstance(caught.value.__cause__, BrokenExecutor)
    kept = {int(path.name.split("-")[1]) for path in run.glob("designs-*.npy")}
    assert 640 not in kept and len(kept) >= 5
    log.unlink()
    with ProcessPoolExecutor(2, fork) as pool:
        found = survey(hitch, over, measure, executor=pool, folder=run)
    again = {int(np.flatnonzero(over["OB"] == first)[0]) for first in read(log)}
    assert again == set(range(0, 1280, 64)) - kept, "neither more nor less than what was missing"
    same(found, survey(hitch, over, travel))


@PROCESS
@pytest.mark.slow
def test_dask_goes_on_when_a_worker_is_killed(small, client, tmp_path):
    hitch, over = hitch_designs(1280)
    log = tmp_path / "log"
    before = set(client.run(os.getpid).values())
    found = survey(hitch, over, functools.partial(deadly, log=log, victim=over["OB"][700]), executor=client.get_executor())
    assert log.with_suffix(".killed").exists()
    starts = sorted(int(np.flatnonzero(over["OB"] == first)[0]) for first in read(log))
    assert set(starts) == set(range(0, 1280, 64)) and len(starts) <= 20 + 4, "only what the killed one had at hand is done again"
    same(found, survey(hitch, over, travel))
    client.wait_for_workers(1)
    assert set(client.run(os.getpid).values()) != before


def test_executor_that_is_shut_down():
    pool = ThreadPoolExecutor(1)
    pool.shutdown()
    with pytest.raises(StudyError, match=r"0 of 100 designs .* has to be made anew \(RuntimeError: cannot sch"):
        survey(*hitch_designs(100), travel, executor=pool)


class Forgetful:
    """An executor that loses some calls."""

    def __init__(self, lost):
        self.lost, self.calls = lost, []

    def submit(self, function, task, start, *rest):
        future = Future()
        self.calls.append((start, rest[-1]))
        if rest[-1] < self.lost.get(start, 0):
            future.set_exception(OSError("the connection was closed"))
        else:
            future.set_result(function(task, start, *rest))
        return future


def test_lost_batch_is_sent_again(small):
    hitch, over = hitch_designs(640)
    executor = Forgetful({0: 1, 320: 2})
    same(survey(hitch, over, travel, executor=executor), survey(hitch, over, travel))
    assert executor.calls.count((320, 0)) == executor.calls.count((320, 1)) == executor.calls.count((320, 2)) == 1
    assert len(executor.calls) == 10 + 3


def test_batch_that_is_lost_again_and_again(small, tmp_path):
    hitch, over = hitch_designs(640)
    with pytest.raises(StudyError, match=r"320 of 640 .* Designs 320 to 383 were lost 3 times.*OSError: the conn") as caught:
        survey(hitch, over, travel, executor=Forgetful({320: 9}), folder=tmp_path)
    assert caught.value.designs == (320, 383) and isinstance(caught.value, LinkageError)
    same(survey(hitch, over, travel, folder=tmp_path), survey(hitch, over, travel))


@pytest.mark.slow
def test_interrupt_calls_back_what_is_queued(small, client, tmp_path):
    hitch, over = hitch_designs(64 * 40)
    log = tmp_path / "log"

    def stop(done, total):
        if done >= 512:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        survey(hitch, over, functools.partial(logged, log=log), executor=client.get_executor(), progress=stop)
    assert len(read(log)) < 30
