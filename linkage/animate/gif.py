"""Frames written as a GIF: one palette, and only what changes from frame to frame."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
from PIL import Image

from ..disk import replacing
from .course import RATE

COLOURS, APART = 120, 9
"""How many colours the palette holds, and how far they stand apart, of 255."""


def write_gif(path: Path, frames: Iterable[npt.NDArray[np.uint8]], order: Sequence[int], sample: npt.NDArray[np.uint8]) -> None:
    """Write frames, one for each pose of `order` met first, in that order; `sample` is a picture with all colours."""
    palette = palette_of(sample)
    pictures: dict[int, Image.Image] = {}
    for pose, frame in zip(dict.fromkeys(order), frames, strict=True):
        pictures[pose] = Image.fromarray(frame).quantize(palette=palette, dither=Image.Dither.NONE)
    first, *others = [pictures[pose] for pose in order]
    with replacing(path) as stream:
        options: dict[str, Any] = {"duration": 1000 // RATE, "loop": 0, "disposal": 1, "optimize": True}
        first.save(stream, "GIF", save_all=True, append_images=others, **options)


def palette_of(sample: npt.NDArray[np.uint8]) -> Image.Image:
    """Return a picture whose palette holds the most frequent colours of a sample, the paper first, none like another.

    Pillow finds a pixel's colour in the palette to a few steps in 256, so two like colours would mix.
    """
    packed, counts = np.unique(sample.astype(np.uint32) @ np.array([1 << 16, 1 << 8, 1], np.uint32), return_counts=True)
    ranked = packed[np.argsort(-counts, kind="stable")]
    chosen: list[npt.NDArray[np.int64]] = []
    for code in ranked.tolist():
        colour = np.array([code >> 16, code >> 8 & 255, code & 255])
        if all(np.abs(colour - other).max() >= APART for other in chosen):
            chosen.append(colour)
        if len(chosen) == COLOURS:
            break
    palette = Image.new("P", (1, 1))
    palette.putpalette(np.concatenate(chosen).tolist())
    return palette
