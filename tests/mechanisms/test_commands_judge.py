"""Every command judges what the machine declares: the lines that it prints are those of the machine's own verdicts."""

import re

import pytest

from linkage.cli import main
from linkage.cli.machines import find
from tests.for_all import for_all

COMMANDS = {
    "grapple": "grapple",
    "table grapple --check": "grapple",
    "hitch --count 2 --over S=0:0.1": "three_point_hitch",
    "balance header_balancer --count 2": "header_balancer",
    "balance header_balancer --table --pressure 40kgf_cm2": "header_balancer",
    "crane arm_drive": "arm_drive",
    "crane boom_drive --set phi_k=90deg --set p=200bar": "boom_drive",
}
CHANGED = {
    "balance header_balancer --table --pressure 40kgf_cm2": {"charge": 40 * 98066.5},
    "crane boom_drive --set phi_k=90deg --set p=200bar": {"phi_k": 1.5707963267948966, "p": 20e6},
}


def judged_lines(text):
    """Return the lines of rules in what a command prints."""
    return [line.strip() for line in text.splitlines() if re.match(r" *(ok  |FAIL|--  ) ", line)]


def disagreement(arguments, name, capsys):
    """Return how a command judges otherwise than its machine does, in words; empty where it does not."""
    code = main(arguments.split() + (["--check"] if "--check" not in arguments else []))
    printed = judged_lines(capsys.readouterr().out)
    over = {"S": (0.0, 0.1)} if "--over" in arguments else None
    own = [each for each in find(name)(**CHANGED.get(arguments, {})).verdicts(over=over) if each.is_rule]
    if printed != own or code != (1 if any(each.ok is False for each in own) else 0):
        return f"{arguments}: exit {code}\n  " + "\n  ".join(sorted(set(printed) ^ set(own)))
    return ""


FEW = ("hitch --count 2 --over S=0:0.1", "crane arm_drive")


@for_all("arguments", FEW, slow=[arguments for arguments in COMMANDS if arguments not in FEW])
def test_commands_print_the_verdicts_of_the_machine(arguments, capsys):
    assert not disagreement(arguments, COMMANDS[arguments], capsys)


@pytest.mark.slow
def test_the_crane_tells_what_its_cylinders_fail(capsys):
    for name in ("crane", "mechanisms.crane:BellCrankCrane"):
        assert not disagreement(f"crane {name}", name, capsys)


@pytest.mark.slow
def test_a_command_writes_no_verdicts_into_csv(capsys):
    assert main(["table", "grapple", "--check", "--csv", "-"]) == 1
    assert not judged_lines(capsys.readouterr().out)
