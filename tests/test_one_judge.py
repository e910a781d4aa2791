"""One judge: outside it no code chooses for itself where it looks, in which load case and direction, or what no value means."""

import ast

from tests.tools.sources import nodes, sources

JUDGE = {"linkage/motion/judge.py", "linkage/motion/search.py", "linkage/numeric/line.py", "linkage/numeric/box.py"}
"""The judge, and the search that it rests on, with its doors `greatest` and `lowest`."""

ALLOWED = {
    # what is drawn and typeset: axes, scales, decimals, sizes of lists
    "linkage/pictures/": "axes and scales of pictures",
    "linkage/exports/live_results.py": "the size of a column, against which a formula's column is compared",
    "linkage/exports/workbook.py": "number formats and axes of a sheet",
    "linkage/exports/calculation.py": "the size of a column, against which a formula's column is compared",
    "linkage/motion/table.py": "the size of a column, by which rounding noise is told",
    "linkage/reports/live_columns.py": "the size of a column, against which a page's column is compared",
    # numbers of samples, of poses that were asked for, and of what was given
    "linkage/loads/element.py": "a given number in a message",
    "linkage/statics/vehicle.py": "how much a motion's supports would have to hold down, in a remark on these poses",
    "hydraulics/accumulator.py": "a given number in a message; vessels, not poses",
    "linkage/motion/stroke_search.py": "whether an angle moves at all",
    "linkage/motion/poles.py": "the points of a body that are farthest apart",
    "linkage/statics/table.py": "a door to the search, of results of pin_forces; a machine's table asks the judge",
    "linkage/statics/joint_forces.py": "the residual of the equations, and words on poses that were asked for",
    "linkage/statics/work.py": "the residual of the equations",
    "linkage/documents/checks.py": "residuals of a calculation's own checks",
    "linkage/documents/forces.py": "pin forces beyond what the machine runs, against a stop, at the judge's own poses, as the report says",
    "linkage/study/": "statistics of samples of designs",
    "linkage/synthesis/": "sizes of tasks and curves, statistics of samples of designs",
    "linkage/files/study_tasks.py": "statistics of samples of designs",
}  # fmt: skip
"""Files, or folders, that may ask for the greatest and least of numbers, with what these are."""

NAMES = {"nanmax", "nanmin", "greatest", "lowest"}
LOOPED = {"DIRECTIONS", "LoadCase"}


def calls_of(source):
    """Yield the names of functions that are called, with their lines."""
    for node in nodes(source)[ast.Call]:
        name = node.func.attr if isinstance(node.func, ast.Attribute) else node.func.id if isinstance(node.func, ast.Name) else ""
        yield name, node


def loops_of(source):
    """Yield what is looped over, as nodes."""
    for node in (*nodes(source)[ast.For], *nodes(source)[ast.comprehension]):
        yield node.iter


def halved_strokes(source):
    """Yield the lines where the middle of start and end of a stroke is taken."""
    for node in nodes(source)[ast.BinOp]:
        if isinstance(node.op, (ast.Mult, ast.Div)):
            names = {each.attr for each in ast.walk(node) if isinstance(each, ast.Attribute)}
            numbers = {each.value for each in ast.walk(node) if isinstance(each, ast.Constant)}
            if {"start", "end"} <= names and numbers & {0.5, 2} and any(isinstance(each, ast.Add) for each in ast.walk(node)):
                yield node.lineno


def found_in(name, source):
    """Return what a file decides for itself that is the judge's."""
    if name in JUDGE:
        return []
    found = []
    if not any(name.startswith(each) for each in ALLOWED):
        found += [f"{name}:{node.lineno} calls {called}" for called, node in calls_of(source) if called in NAMES]
    for over in loops_of(source):
        words = {each.id for each in ast.walk(over) if isinstance(each, ast.Name)}
        if words & LOOPED and name not in LISTED:
            found.append(f"{name}:{over.lineno} loops over {', '.join(sorted(words & LOOPED))}")
    if name not in MIDDLES:
        found += [f"{name}:{line} halves start + end of a stroke" for line in halved_strokes(source)]
    return found


LISTED = {
    "linkage/mechanism.py": "names of load cases, which may not be a word of the framework",
    "linkage/cli/settings.py": "names of load cases, for the error of an unknown one",
    "linkage/documents/inputs.py": "titles of load cases, which a catalogue has in another language",
    "linkage/motion/requests.py": "the order of directions",
    "hydraulics/shut.py": "names of load cases, for those that shut a line",
}
"""Files that go through load cases or directions without judging any."""

MIDDLES = {
    "linkage/cli/report.py": "where strokes of a picture stand that are not named",
    "linkage/notebook.py": "where strokes of a picture stand that are not named",
    "linkage/pictures/dimensioned.py": "where strokes of a picture stand that are not named",
    "linkage/reports/runs.py": "where strokes of a picture stand that are not named",
    "linkage/pictures/page_data.py": "where sliders begin",
    "linkage/synthesis/exact.py": "the middle of the angles of a driven link, no stroke",
    "linkage/synthesis/exact_poses.py": "the middle of the angles of a driven link, no stroke",
}


def test_only_the_judge_looks_for_extremes_and_loops_over_cases_and_directions():
    found = [fault for name, source in sources().items() for fault in found_in(name, source)]
    assert not found, "\n".join(found)
