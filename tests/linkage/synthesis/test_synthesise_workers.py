"""A synthesis by any executor and in a folder: the same bits whoever searches, and from where another call stopped."""

import json
import multiprocessing
import pickle
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor

import numpy as np
import pytest

from linkage import DefinitionError, FunctionTask, PathTask, deg, distance, least, mm, most, synthesise, transmission
from linkage.synthesis.task_work import joined_rows
from mechanisms.classics.four_bar import FourBar
from tests.linkage.synthesis import synthesis_tasks as papers
from tests.linkage.synthesis.synthesis_tasks import Bar

TASK = PathTask(np.array(papers.FIVE) * mm, of="P", at=papers.FIVE_AT)
VARY = {"OA": (1 * mm, 9 * mm), "AB": (3 * mm, 40 * mm), "CB": (3 * mm, 40 * mm), "C.x": (1 * mm, 30 * mm), "AP": [1 * mm, 2 * mm]}


def bits(found):
    """Return all that a synthesis says, to the last bit."""
    numbers = [(each.error, each.at.tolist(), each.base.tolist(), each.strokes.tolist()) for each in found.solutions]
    return numbers, [(each.error, each.why) for each in found.misses], str(found), found.evaluations


def searched(**options):
    """Return a search of some stages, with a condition and choices."""
    given = {"path": TASK, "vary": VARY, "subject_to": [least(transmission("B")) >= 55 * deg], "starts": 3, "seed": 1} | options
    return synthesise(Bar(), **given)


@pytest.fixture(scope="module")
def alone():
    return searched()


@pytest.mark.slow
def test_threads_give_the_same_bits(alone):
    with ThreadPoolExecutor(3) as pool:
        assert bits(searched(executor=pool)) == bits(alone)
    assert alone.solutions


@pytest.mark.slow
def test_processes_give_the_same_bits(alone):
    with ProcessPoolExecutor(2, multiprocessing.get_context("spawn")) as pool:
        assert bits(searched(executor=pool)) == bits(alone)


@pytest.mark.slow
def test_dask_gives_the_same_bits(alone, tmp_path):
    distributed = pytest.importorskip("distributed")
    options = {"n_workers": 1, "threads_per_worker": 2, "processes": False, "dashboard_address": None}
    with distributed.LocalCluster(local_directory=str(tmp_path), **options) as cluster, distributed.Client(cluster) as client:
        assert bits(searched(executor=client.get_executor())) == bits(alone)


@pytest.mark.slow
@pytest.mark.parametrize("calls", [3, pytest.param(7, marks=pytest.mark.slow)])
def test_a_search_that_was_interrupted_goes_on(alone, tmp_path, calls):
    left = [calls]

    def stop(done, total):
        left[0] -= 1
        if not left[0]:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        searched(folder=tmp_path, progress=stop)
    kept = sorted(tmp_path.rglob("*.npy"))
    assert kept
    before = [path.stat().st_mtime_ns for path in kept]
    assert bits(searched(folder=tmp_path)) == bits(alone)
    assert [path.stat().st_mtime_ns for path in kept] == before
    every = sorted(tmp_path.rglob("*.npy"))
    assert len(every) > len(kept)
    assert bits(searched(folder=tmp_path)) == bits(alone)
    assert sorted(tmp_path.rglob("*.npy")) == every


@pytest.mark.slow
def test_what_is_torn_is_searched_again(alone, tmp_path):
    searched(folder=tmp_path)
    for path in tmp_path.rglob("*.npy"):
        path.write_bytes(path.read_bytes()[:-3])
    assert bits(searched(folder=tmp_path)) == bits(alone)


@pytest.mark.parametrize(
    ("other", "words"),
    [
        ({"seed": 2}, "seed .1 there, 2 here"),
        ({"starts": 7}, "starts .3 there, 7 here"),
        ({"path": PathTask(np.array(papers.FIVE)[:4] * mm, of="P", at=papers.FIVE_AT[:4])}, "points .5 there, 4 here"),
        ({"path": PathTask(np.array(papers.FIVE) * 2 * mm, of="P", at=papers.FIVE_AT)}, "their values"),
        ({"path": PathTask(np.array(papers.FIVE) * mm, of="B", at=papers.FIVE_AT)}, "PathTask of P there, PathTask of B here"),
        ({"timed": False}, "timed .True there, False here"),
        ({"vary": {"OA": (1 * mm, 2 * mm)}}, "vary"),
        ({"subject_to": [most(distance("O", "C")) <= 5 * mm]}, "subject_to"),
    ],
)
def test_a_folder_of_another_task_is_refused(tmp_path, monkeypatch, other, words):
    from linkage.synthesis import task_search

    monkeypatch.setattr(task_search.TaskSearch, "run", lambda self, stages: None)
    searched(folder=tmp_path)
    assert json.loads((tmp_path / "study.json").read_text())["starts"] == 3
    searched(folder=tmp_path)
    with pytest.raises(DefinitionError, match=f"holds another study; it differs in .*{words}"):
        searched(folder=tmp_path, **other)


def test_a_function_without_source_text_has_no_folder(tmp_path):
    held = [least(lambda motion: motion.distance("O", "C")) >= 1 * mm]
    with pytest.raises(DefinitionError, match="folder=: a folder cannot tell a function"):
        searched(folder=tmp_path, subject_to=held)


def test_what_goes_to_workers_is_small_and_whole(alone):
    problem = pickle.loads(pickle.dumps(alone.problem))
    unit = np.full((3, len(problem.space.variables)), 0.4)
    one, two = (each.changed(count=None).missing_of_each((1,), unit) for each in (problem, alone.problem))
    assert np.array_equal(one, two)
    assert len(pickle.dumps(alone.problem)) < 100_000


def test_rows_of_several_combinations_keep_their_order():
    rows = joined_rows([((0, 1), {"at": np.zeros((2, 3))}), ((1, 0), {"at": np.ones((1, 3))})])
    assert rows.count == 3 and rows.numbers_each == 5
    assert rows.dimensions(1, 3)["combination"].tolist() == [[0, 1], [1, 0]]
    assert rows.digests() != joined_rows([((0, 1), {"at": np.zeros((3, 3))})]).digests()


def test_a_limit_is_kept_nearly_and_told():
    found = searched(limit=3000)
    assert found.limit == 3000 and 1000 < found.evaluations < 6000
    assert "The limit of 3000 designs was reached" in str(found)
    with ThreadPoolExecutor(2) as pool:
        assert bits(searched(limit=3000, executor=pool)) == bits(found)


def test_an_executor_that_is_none_is_refused():
    with pytest.raises(DefinitionError, match="has no submit"):
        synthesise(FourBar(), function=FunctionTask([0.1], [0.2], of="psi"), vary={"OA": (0.03, 0.05)}, executor=3)
