"""What a stroke measures: a length, an angle, or nothing, as a share of a length does; all that shows it knows."""

import numpy as np
import pytest

from linkage import (
    Crank,
    Dimension,
    Ground,
    Guide,
    Mechanism,
    OnGuide,
    Stroke,
    Weight,
    drive_force,
    driving_force,
    most,
    page,
    pin_forces,
    report,
)
from linkage.files import load, to_toml
from linkage.motion import stroke_unit
from linkage.plan.members import strokes_text
from linkage.reports import results
from linkage.units import deg, litre, mm
from tests.for_all import first_daily
from tests.linkage.pictures.test_page import data_of


def turned(angle, end=1.0):
    """Return a machine whose crank stands at an angle that a stroke S and the dimensions r and swing make."""

    class Turned(Mechanism):
        S = Stroke(0.0, end)
        r, swing = Dimension(0.2, unit="mm"), Dimension(80 * deg, unit="deg")
        O = Ground(0.0, 0.0)
        P = Crank(O, OP=1.0, angle=angle(S, r, swing))
        load = Weight(P, mass=100)

    return Turned


def pushed(length, end=1.0):
    """Return a machine whose slider stands where a stroke S and the dimensions r and swing say."""

    class Pushed(Mechanism):
        S = Stroke(0.0, end)
        r, swing = Dimension(0.2, unit="mm"), Dimension(80 * deg, unit="deg")
        O = Ground(0.0, 0.0)
        rail = Guide(O, angle=90 * deg)
        P = OnGuide(rail, at=length(S, r, swing))
        load = Weight(P, mass=100)

    return Pushed


KINDS = [
    (turned(lambda S, r, swing: S - swing), "rad"),
    (turned(lambda S, r, swing: 20 * deg - 0.5 * S), "rad"),
    (turned(lambda S, r, swing: -S / 2.0, 90 * deg), "rad"),
    (turned(lambda S, r, swing: S / r), "m"),
    (turned(lambda S, r, swing: swing * S), ""),
    (turned(lambda S, r, swing: 20 * deg + (1.0 - S) * swing), ""),
    (pushed(lambda S, r, swing: 0.5 + S), "m"),
    (pushed(lambda S, r, swing: 0.5 + 2.0 * S), "m"),
    (pushed(lambda S, r, swing: 0.5 + r * S), ""),
    (pushed(lambda S, r, swing: r * (S + 1.0) / 2.0), ""),
    (pushed(lambda S, r, swing: r * swing * S), ""),
    (pushed(lambda S, r, swing: r * S, 90 * deg), "rad"),
    (pushed(lambda S, r, swing: 0.5 + S * (200 * mm)), ""),
    (pushed(lambda S, r, swing: 300 * mm * S + 0.2), ""),
    (turned(lambda S, r, swing: S * (70 * deg) + 5 * deg), ""),
    (pushed(lambda S, r, swing: 0.5 + S / 0.01, 2 * litre), "m3"),
]
SHOWN = {"m": ("mm", "kN", "1000"), "rad": ("deg", "Nm", ""), "": ("", "Nm", "1"), "m3": ("l", "bar", "2")}


@pytest.mark.parametrize(("kind", "unit"), KINDS)
def test_all_that_shows_a_stroke_knows_what_it_measures(kind, unit):
    machine, (shown, force, end) = kind(), SHOWN[unit]
    motion = machine.sweep(3)
    assert stroke_unit(kind.plan, "S") == unit
    assert stroke_unit(load(to_toml(kind)).plan, "S") == unit
    assert stroke_unit(load(to_toml(load(to_toml(kind)))).plan, "S") == unit
    assert strokes_text(kind.plan, {"S": 0.5}).endswith(f" {shown}".rstrip())  # a remark's words
    (limits,) = motion.limits().values()
    assert str(limits).splitlines()[0].endswith(f"{end} {shown}".rstrip() if end else f" {shown}")
    drive = next(column for column in results(machine, motion) if column.name in ("drive force", "torque"))
    assert drive.unit == force
    assert str(pin_forces(motion)).splitlines()[1].endswith(f" {'N' if force == 'kN' else force}")
    (answer,) = machine.answers([most(drive_force())])
    assert answer.value == pytest.approx(driving_force(motion).max())
    assert f" {force} at S = " in str(answer)
    assert str(answer).endswith(shown)


@first_daily(1, ("kind", "unit"), [KINDS[place] for place in (1, 4, 7)])
def test_a_page_and_a_report_say_it_in_its_unit(kind, unit, tmp_path):
    machine, (shown, force, _) = kind(), SHOWN[unit]
    assert data_of(page(machine, tmp_path / "it.html").read_text())["strokes"][0]["unit"] == shown
    text = report(machine, tmp_path / "it.md").read_text()
    assert ("Nm" in text) == (force == "Nm")
    assert ("S = 0 to 1 " in text, "S = 0 mm" in text) == ((True, False) if shown == "" else (False, shown == "mm"))


def test_a_share_moves_as_its_travel_says():
    by_share, by_length = pushed(lambda S, r, swing: 0.5 + r * S)(), pushed(lambda S, r, swing: 0.5 + S, 0.2)()
    shares = np.linspace(0.0, 1.0, 4)
    assert by_share.at(S=shares)["P"] == pytest.approx(by_length.at(S=0.2 * shares)["P"])
    assert driving_force(by_share.at(S=shares)) == pytest.approx(0.2 * driving_force(by_length.at(S=0.2 * shares)))
