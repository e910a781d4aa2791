"""Machines at work: whole machines to copy, many of them of parts that stand on one another."""

from linkage.star import declare_public

declare_public(globals())
