"""A figure that is saved as every file here is: whole, or what stood there is left as it was."""

from __future__ import annotations

import os
from io import BytesIO
from pathlib import Path
from typing import Any

from matplotlib import rcParams
from matplotlib.figure import Figure

from ..disk import check_place, replacing


class Picture(Figure):
    """A matplotlib figure whose `savefig` replaces a file whole; FileError, in words, where it cannot be written."""

    def savefig(self, fname: Any, **options: Any) -> None:
        """Write the picture into a file, in the format that its name's ending says, or into a stream."""
        if not isinstance(fname, (str, os.PathLike)):
            super().savefig(fname, **options)
            return
        path = Path(fname)
        kind = options.pop("format", None) or path.suffix[1:] or str(rcParams["savefig.format"])
        path = path if path.suffix else path.with_name(f"{path.name}.{kind}")
        check_place(path)
        drawn = BytesIO()
        super().savefig(drawn, format=kind, **options)
        with replacing(path) as stream:
            stream.write(drawn.getvalue())
