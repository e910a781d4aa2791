"""Surroundings of a mechanism that are only drawn: a wheel, the ground, a bucket, a photograph."""

from ..star import declare_public
from .outline import CircleOutline as CircleOutline
from .outline import Corner as Corner
from .outline import DxfOutline as DxfOutline
from .outline import ImageOutline as ImageOutline
from .outline import LineOutline as LineOutline
from .outline import Outline as Outline
from .outline import dxf_entities, numbers_at, visible

declare_public(globals())
