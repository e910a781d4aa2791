"""Machines at work: whole machines to copy, many of them of parts that stand on one another."""
