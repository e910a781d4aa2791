"""Ten thousand random mechanisms from steps: every law, every back end, files. A chunk of them a test; a violation names its seed."""

import ctypes
import json
import shutil
import subprocess
import warnings
from importlib.util import find_spec
from inspect import unwrap

import numpy as np
import pytest

from linkage import SingularWarning, ratio
from linkage.files import load, to_toml
from tests.laws import test_laws, test_readings, test_statics_laws
from tests.linkage.random_mechanisms import random_mechanism

CHUNK = 100
CHUNKS = 100
LAWS = {
    "links keep their length": unwrap(test_laws.test_links_keep_their_length),
    "cylinders are as long as they say": unwrap(test_laws.test_cylinders_are_as_long_as_they_say),
    "the exact ratio is the numerical one": lambda machine: unwrap(test_laws.test_exact_ratio_is_the_numerical_one)(machine, 1),
    "so is that of second order": lambda machine: unwrap(test_laws.test_exact_ratio_is_the_numerical_one)(machine, 2),
    "the error of a difference falls with its order": unwrap(test_laws.test_error_of_the_plain_difference_falls_with_its_order),
    "scaling": unwrap(test_laws.test_scaling_all_lengths_scales_positions),
    "a mirror": lambda machine: test_laws.is_plain(machine) and unwrap(test_laws.test_mirroring_swaps_left_and_right)(machine),
    "a pose does not depend on the others": unwrap(test_laws.test_a_pose_does_not_depend_on_the_others),
    "the steps and the program": unwrap(test_readings.test_places_by_the_program_and_by_the_steps),
    "the kernel node by node": lambda machine: unwrap(test_readings.test_kernel_is_the_program_node_by_node)(machine, 3, 40),
    "the guards": unwrap(test_readings.test_guards_tell_whether_a_pose_is_out_of_reach),
    "virtual work is equilibrium": unwrap(test_statics_laws.test_virtual_work_is_equilibrium),
    "every body is in equilibrium": unwrap(test_statics_laws.test_every_body_is_in_equilibrium),
    "the frame carries all weight": unwrap(test_statics_laws.test_the_frame_carries_all_weight),
    "reactions scale and add up": unwrap(test_statics_laws.test_reactions_scale_with_loads_and_add_up),
}
KEPT = (test_laws.whole, test_readings.everything, test_readings.kernel)


def drawn_at_random(seed):
    """Return a random mechanism of one to three strokes and up to eight joints."""
    return random_mechanism(100_000 + seed, strokes=1 + seed % 3, joints=4 + seed % 5)


def poses(machine, seed, count=9):
    """Return strokes inside a mechanism's ranges."""
    random = np.random.default_rng(seed)
    return {name: each.start + (each.end - each.start) * random.uniform(0.0, 1.0, count) for name, each in machine.plan.strokes.items()}


def asked(machine):
    """Return what every back end is asked for: the last point, its ratios, that of an output."""
    last, strokes = machine.plan.moving[-1], list(machine.plan.strokes)
    return [last, *(ratio(last, each) for each in strokes), ratio(last, strokes[0], 2), ratio("u", strokes[-1])]


def rows(values):
    """Return the results of a list of requests, one row a component."""
    return np.vstack([np.atleast_2d(each) for each in values])


def agree(found, wanted):
    """Assert that results agree to 1e-10 of each row's size, 1 m at least."""
    size = np.maximum(np.abs(wanted).max(axis=1, keepdims=True), 1.0)
    worst = float((np.abs(found - wanted) / size).max())
    assert worst < 1e-10, worst


def check_readings(machine, seed):
    """Blocks, floats and one pose at a time, the gradient, and the mechanism read back from its file."""
    made, strokes = machine(), poses(machine, seed)
    wanted = rows(made.evaluate(asked(machine), backend="numpy", **strokes))
    agree(rows(made.evaluate(asked(machine), backend="floats", **strokes)), wanted)
    function = made.function(asked(machine))
    agree(np.array([function(*each) for each in zip(*strokes.values(), strict=True)]).T, wanted)
    if seed % 1000 == 0 and find_spec("numba") is not None:
        agree(rows(made.evaluate(asked(machine), backend="numba", **strokes)), wanted)
    back = load(to_toml(machine))()
    np.testing.assert_array_equal(rows(back.evaluate(asked(back), backend="numpy", **strokes)), wanted)
    check_gradient(machine, strokes, seed)


def check_gradient(machine, strokes, seed):
    """The gradient of the last point by a dimension, against differences of designs, extrapolated once."""
    last, random = machine.plan.moving[-1], np.random.default_rng(seed)
    name = str(random.choice(list(machine.plan.table.entries)))
    value = machine.plan.table.entries[name].default
    found = machine().at(**strokes).gradient(last, wrt=[name])[0]
    slopes = []
    for step in (2e-4, 1e-4):
        up, down = (machine(**{name: value + each}).at(**strokes)[last] for each in (step, -step))
        slopes.append((up - down) / (2.0 * step))
    wanted = (4.0 * slopes[1] - slopes[0]) / 3.0
    assert np.abs(found - wanted).max() < 1e-6 * max(1.0, np.abs(wanted).max()), name


def check_text(machines, folder):
    """Yield the seeds whose C or JavaScript says anything else, with the language."""
    for language, said in (("c", said_by_c), ("javascript", said_by_javascript)):
        texts = {seed: machine().source(asked(machine), language=language, name=f"poses{seed}") for seed, machine in machines.items()}
        found = said(texts, {seed: (machine, poses(machine, seed)) for seed, machine in machines.items()}, folder)
        for seed, values in found.items():
            try:
                agree(values, rows(machines[seed]().evaluate(asked(machines[seed]), backend="numpy", **poses(machines[seed], seed))))
            except AssertionError as error:
                yield seed, language, error


def stated(text, part, machine):
    """Return the names that a text's comment states as `d` or `p`, or the values where it gives them."""
    start = text.index(f"{part}: ") + 3
    ends = "; p: " if part == "d" else "; "
    each = text[start : text.index(ends, start)].split(", ")
    return [float(word.rpartition(" = ")[2]) for word in each] if part == "d" else each


def said_by_c(texts, given, folder):
    """Return what the texts say, compiled in one library, by seed; nothing where there is no compiler."""
    if shutil.which("cc") is None:
        return {}
    source = folder / f"many{min(texts)}.c"  # a library of a name that was loaded before would not be loaded again
    source.write_text("\n".join(texts.values()), encoding="utf-8")
    subprocess.run(["cc", "-O1", "-shared", "-fPIC", "-o", source.with_suffix(".so"), source, "-lm"], check=True)
    library, pointer = ctypes.CDLL(str(source.with_suffix(".so"))), ctypes.POINTER(ctypes.c_double)

    def pointed(arrays):
        return (pointer * len(arrays))(*(each.ctypes.data_as(pointer) for each in arrays))

    found = {}
    for seed, text in texts.items():
        machine, strokes = given[seed]
        inputs = [np.ascontiguousarray(strokes[name]) for name in stated(text, "p", machine)]
        design = np.array(stated(text, "d", machine))
        out = np.empty((int(text.split(" outputs */")[0].rpartition(" ")[2]), inputs[0].size))
        getattr(library, f"poses{seed}")(ctypes.c_long(out.shape[1]), design.ctypes.data_as(pointer), pointed(inputs), pointed(list(out)))
        found[seed] = out
    return found


def said_by_javascript(texts, given, folder):
    """Return what the texts say, run in one process, by seed; nothing where there is no node."""
    if shutil.which("node") is None:
        return {}
    calls = []
    for seed, text in texts.items():
        machine, strokes = given[seed]
        at = np.transpose([strokes[name] for name in stated(text, "p", machine)]).tolist()
        calls.append(f"said[{seed}] = {json.dumps(at)}.map(p => poses{seed}({json.dumps(stated(text, 'd', machine))}, p));")
    script = "\n".join([*texts.values(), "const said = {};", *calls, "console.log(JSON.stringify(said));"])
    (folder / "many.js").write_text(script, encoding="utf-8")
    said = subprocess.run(["node", str(folder / "many.js")], check=True, capture_output=True, text=True).stdout
    return {int(seed): np.array(values, float).T for seed, values in json.loads(said).items()}


def violations(seeds, folder):
    """Return what any of some random mechanisms violates: seed, law and words."""
    found, machines = [], {}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SingularWarning)
        for seed in seeds:
            machine = machines[seed] = drawn_at_random(seed)
            for law, check in {**LAWS, "every reading": lambda machine, seed=seed: check_readings(machine, seed)}.items():
                try:
                    check(machine)
                except Exception as error:
                    found.append((seed, law, f"{type(error).__name__}: {error}"[:300]))
            for kept in KEPT:
                kept.cache_clear()
        found += [(seed, language, str(error)) for seed, language, error in check_text(machines, folder)]
    return found


def test_a_few_random_mechanisms_hold_every_law(tmp_path):
    assert violations(range(1, 4), tmp_path) == []  # of two, three strokes and one


@pytest.mark.slow
@pytest.mark.parametrize("chunk", range(CHUNKS))
def test_ten_thousand_random_mechanisms_hold_every_law(chunk, tmp_path):
    assert violations(range(CHUNK * chunk, CHUNK * (chunk + 1)), tmp_path) == []
