"""Dependencies and order, rigid bodies and the Gruebler count."""

from .bodies import Body as Body
from .bodies import gruebler as gruebler
from .bodies import merged as merged
from .order import ordered as ordered
