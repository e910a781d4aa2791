"""Animations: the mechanism over its stroke and a live curve, as .gif, .mp4 or .html."""

from .film import animate as animate
