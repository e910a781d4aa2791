"""Classic linkages, one file each: their known properties are truth for the tests."""

from linkage.star import declare_public

declare_public(globals())
