"""The pictures that pages keep in docs/images, drawn anew by their scripts for the pages that are built."""

from __future__ import annotations

import re
import warnings
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from types import ModuleType

SCRIPTS = Path(__file__).parents[1] / "pictures"
IMAGE = re.compile(r"\]\(images/([\w.]+)\)")
MAKERS = tuple(sorted(path.stem for path in SCRIPTS.glob("*.py")))


def script(name: str) -> ModuleType:
    """Return a script that draws pictures of the pages."""
    spec = spec_from_file_location(f"pictures_{name}", SCRIPTS / f"{name}.py")
    assert spec is not None and spec.loader is not None
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def draw_all(name: str, folder: Path) -> None:
    """Draw what a script draws into a folder."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        found = script(name)
        for picture, make in found.PICTURES.items():
            make().savefig(folder / f"{picture}.png", metadata={"Software": None})
        for film, write in getattr(found, "FILMS", {}).items():
            write(folder / film)
