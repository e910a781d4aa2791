"""What a failure says: what was wrong, what is known, what was probably meant."""

import numpy as np

from linkage import AssemblyError, DefinitionError, FileError, LinkageError, SingularError, StudyError
from linkage.errors import unknown
from tests.for_all import for_all


@for_all("error", [DefinitionError, AssemblyError, SingularError, FileError, StudyError])
def test_every_error_is_a_linkage_error(error):
    assert issubclass(error, LinkageError)


def test_definition_error_is_a_value_error_and_singular_an_assembly_error():
    assert issubclass(DefinitionError, ValueError)
    assert issubclass(SingularError, AssemblyError)


def test_unknown_name_lists_the_known_and_the_nearest():
    text = str(unknown("Dimension", "OBB", ["OB", "CD"], where="Hitch"))
    assert text == "Dimension 'OBB' is unknown in Hitch. Did you mean OB? Known: OB, CD."


def test_unknown_name_with_nothing_near_or_nothing_at_all():
    assert "Did you mean" not in str(unknown("Dimension", "zzz", ["OB"]))
    sizes = ["OB", "lift.bore", "ram.bore", "ram.rod", "ram.stroke"]  # words of the field, of the same member first
    meanings = {"ram.diameter": "ram.bore or ram.rod", "diameter": "lift.bore or ram.bore or ram.rod", "ram.piston": "ram.bore"}
    for word, meant in meanings.items():
        assert f"Did you mean {meant}?" in str(unknown("Dimension", word, sizes))
    assert "Did you mean" not in str(unknown("Dimension", "lift.travel", sizes[:2]))
    assert str(unknown("Stroke", "S", [])).endswith("Known: none.")


@for_all("name", [3, None, ("G",), ["G"], b"G"])
def test_unknown_takes_anything_for_a_name(name):
    assert "is unknown" in str(unknown("Name", name, ["G"]))


def test_assembly_error_carries_the_poses():
    error = AssemblyError("B cannot be assembled", point="B", mask=[True, False], shortfall=0.013)
    assert (error.point, error.mask.tolist(), error.shortfall) == ("B", [True, False], 0.013)
    assert np.isnan(AssemblyError("B").shortfall)
