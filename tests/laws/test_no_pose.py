"""A motion without a pose: every door gives arrays without a value, or says in words that there is no pose."""

import numpy as np
import pytest

from hydraulics import buckling, pressure, reserve, thrust
from hydraulics.cylinders import Ram
from linkage import (
    LinkageError,
    Mechanism,
    PinFriction,
    drive_force,
    driving_force,
    max_table,
    pin_force,
    pin_forces,
    plot,
    report,
)
from mechanisms.at_work.levelled import LevelledTelehandler
from mechanisms.header_balancer import HeaderBalancer
from mechanisms.three_point_hitch import ThreePointHitch
from tests.for_all import for_all
from tests.hydraulics.test_valve import Boom


class Rubbing(Boom):
    """A boom over a holding valve whose pin rubs."""

    worn = PinFriction("O", radius=0.03, coefficient=0.2)


def doors(machine: Mechanism, motion, folder):
    """Yield every door by its name, as a function without arguments."""
    rams = list(machine.plan.of_kind(Ram))
    requests = [drive_force(), *(pin_force(each) for each in list(machine.plan.moving)[:1])]
    requests += [make(each) for each in rams for make in (thrust, pressure, buckling, reserve)]
    yield from ((f"motion[{each}]", lambda each=each: motion[each]) for each in requests)
    yield from ((f"evaluate {each}", lambda each=each: machine.evaluate([each], **motion.strokes)[0]) for each in requests)
    point = list(machine.plan.moving)[-1]
    yield "ratio", lambda: motion.ratio(point, order=2)
    yield "gradient", lambda: motion.gradient(drive_force(), wrt=list(machine.dimensions)[-1:])
    yield "driving_force", lambda: driving_force(motion, direction="extending")
    yield "thrust", lambda: [getattr(machine, each).thrust(motion, direction="extending") for each in rams]
    yield "checks", lambda: [getattr(machine, each).checks(motion) for each in rams]
    yield "over", lambda: motion.over
    yield "limits", motion.limits
    yield "verdicts", lambda: machine.verdicts(motion)
    yield "max_table", lambda: max_table([pin_forces(motion)])
    yield "plot", lambda: plot(motion, [f"{point}_y"])
    yield "report", lambda: report(machine, folder / "none.md", at={name: [] for name in machine.strokes})


@for_all("machine", [Rubbing, HeaderBalancer], slow=[LevelledTelehandler, ThreePointHitch])
def test_no_pose_has_no_value_and_no_bare_error(machine, tmp_path):
    made, said = machine(), 0
    motion = made.at(**{name: [] for name in made.strokes})
    for name, door in doors(made, motion, tmp_path):
        try:
            found = door()
        except LinkageError as error:
            said += "no pose" in str(error) or "no value" in str(error)
        except Exception as error:
            pytest.fail(f"{name}: {type(error).__name__}: {error}")
        else:
            assert np.size(found) == 0 if isinstance(found, np.ndarray) else np.all([np.size(each) == 0 for each in found]), name
    assert said >= 4
