"""Frames written as an MP4 (H.264) through ffmpeg."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

import numpy as np
import numpy.typing as npt

from ..errors import LinkageError
from .course import RATE


def write_mp4(path: Path, frames: Iterable[npt.NDArray[np.uint8]], size: tuple[int, int]) -> None:
    """Write frames of a size, width and height in pixels; LinkageError where ffmpeg is not installed."""
    try:
        import imageio_ffmpeg
    except ImportError:
        raise LinkageError(
            f"{path.name}: an .mp4 needs ffmpeg, which the extra `video` brings: pip install 'hydrolinkage[video]' "
            "(from a checkout: pip install -e '.[video]'). A .gif or .html needs nothing more."
        ) from None
    writer = imageio_ffmpeg.write_frames(str(path), size, fps=RATE, quality=8, macro_block_size=16)
    writer.send(None)
    try:
        for frame in frames:
            writer.send(np.ascontiguousarray(frame))
    finally:
        writer.close()
