"""Shipped machines, one file each."""
