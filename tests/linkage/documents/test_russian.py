"""A report in Russian is Russian: titles, prose and notes of the papers' machines, and of a machine of one's own."""

import re

import pytest

from linkage import report
from linkage.cli.machines import find
from linkage.units import UNITS
from tests.tools.catalogues import OF_PAPERS

MOST = 0.03
CODE = re.compile(r"\$\$.*?\$\$|\$[^$]*\$|`[^`]*`|!\[[^\]]*\]\([^)]*\)|\[[^\]]*\]\([^)]*\)", re.DOTALL)
CALLS = re.compile(r"\b[A-Z]\w*\([^|\n]*\)")
OTHERS = {"hydrolinkage", "Tcos", "TurnV", "bar", "plain"}


def latin_share(machine, text):
    """Return the share of Latin words among those of four letters or more: without names, files, code and formulas."""
    plan = machine.plan
    names = {part for name in (*plan.members, *plan.table.names(), *plan.strokes) for part in re.findall(r"[A-Za-z]+", name)}
    names |= {part for each in (*machine().links, *plan.cylinders) for part in re.findall(r"[A-Za-z]+", str(each))}
    names |= set(re.findall(r"[A-Za-z]+", f"{machine.__module__} {machine.__qualname__}")) | set(UNITS) | OTHERS
    plain = CALLS.sub("", CODE.sub("", text)).replace("\\", "")
    words = [each for each in re.findall(r"[^\W\d_]{4,}", plain) if each not in names]
    latin = [each for each in words if re.match("[A-Za-z]", each)]
    return len(latin) / len(words), latin


QUICK = ("mower_lift",)
MACHINES = [pytest.param(each, marks=() if each in QUICK else pytest.mark.slow) for each in OF_PAPERS]


@pytest.mark.parametrize("name", MACHINES)
def test_a_russian_report_is_russian(name, tmp_path):
    machine = find(name)
    text = report(machine(), tmp_path / "report.md", language="ru").read_text(encoding="utf-8")
    share, latin = latin_share(machine, text)
    assert share <= MOST, latin
