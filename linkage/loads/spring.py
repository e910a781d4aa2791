"""Springs between two points."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, ClassVar, final

import numpy as np

from ..errors import DefinitionError
from ..quantities import Reference, name_of
from .element import ForceElement, Poses
from .load import Load


@final
@dataclass(frozen=True, eq=False)
class Spring(ForceElement):
    """A straight spring from A to B: it pulls its ends together with stiffness (AB - free_length) [N].

    Shorter than its free length [m] it pushes them apart. `relief = Spring(A, B, stiffness=20e3, free_length=0.4)` [N/m].
    """

    A: Reference
    B: Reference
    stiffness: Any
    free_length: Any
    places: ClassVar[tuple[str, ...]] = ("A", "B")
    parameters: ClassVar[Mapping[str, str]] = MappingProxyType({"stiffness": "", "free_length": "mm"})
    not_negative: ClassVar[frozenset[str]] = frozenset({"stiffness", "free_length"})

    def loads(self, motion: Poses) -> list[Load]:
        AB = self.position(motion, "B") - self.position(motion, "A")
        stiffness, free = self.number(motion, "stiffness"), self.number(motion, "free_length")
        length = np.hypot(AB[0], AB[1])
        if np.any((length == 0.0) & (free > 0.0)):
            raise DefinitionError(f"{self.name} = {self}: its ends coincide at some poses and give no direction; move one of them.")
        pull = stiffness * AB * (1.0 - free / np.where(length == 0.0, 1.0, length))
        return [Load(name_of(self.A), pull), Load(name_of(self.B), -pull)]
