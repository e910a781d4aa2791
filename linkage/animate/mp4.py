"""Frames written as an MP4 (H.264) through ffmpeg."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from shutil import copyfileobj
from tempfile import TemporaryDirectory, gettempdir

import numpy as np
import numpy.typing as npt

from ..disk import replacing, spoken
from ..errors import FileError, LinkageError
from .course import RATE


def write_mp4(path: Path, frames: Iterable[npt.NDArray[np.uint8]], size: tuple[int, int]) -> None:
    """Write frames of a size, width and height in pixels; LinkageError where ffmpeg is not installed, FileError where it fails."""
    try:
        import imageio_ffmpeg
    except ImportError:
        raise LinkageError(
            f"{path.name}: an .mp4 needs ffmpeg, which the extra `video` brings: pip install 'hydrolinkage[video]' "
            "(from a checkout: pip install -e '.[video]'). A .gif or .html needs nothing more."
        ) from None
    with replacing(path) as stream, TemporaryDirectory() as folder:
        film, sent = Path(folder) / "film.mp4", 0
        writer = imageio_ffmpeg.write_frames(str(film), size, fps=RATE, quality=8, macro_block_size=16)
        writer.send(None)
        try:
            for sent, frame in enumerate(frames, 1):  # noqa: B007 - counted to the end
                writer.send(np.ascontiguousarray(frame))
        finally:
            writer.close()
        try:
            held, _ = imageio_ffmpeg.count_frames_and_secs(str(film))
        except RuntimeError:  # ffmpeg cannot read what it wrote
            held = 0
        if held != sent:
            room = f"make room in {gettempdir()}, where it works"
            raise FileError(f"{spoken(path)}: ffmpeg wrote {held} of {sent} frames; {room}, or choose .gif or .html.")
        with film.open("rb") as whole:
            copyfileobj(whole, stream)
