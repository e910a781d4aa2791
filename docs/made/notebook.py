"""The notebook as a page: it is run when the pages are built, and its cells are shown with what they gave."""

from __future__ import annotations

import base64
import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any


def executed(path: Path) -> Any:
    """Return a notebook as it is after all of its cells were run."""
    import nbformat
    from nbclient import NotebookClient

    notebook = nbformat.read(path, as_version=4)
    folder, quiet = str(path.parents[1]), ["--log-level=ERROR"]  # a kernel warns of its own ports, which only this machine sees
    client = NotebookClient(notebook, timeout=300, kernel_name="python3", resources={"metadata": {"path": folder}}, extra_arguments=quiet)
    client.execute(env=os.environ | {"PYTHONPATH": folder})
    return notebook


def make(path: Path, page: Path) -> None:
    """Write a notebook, run, as a page."""
    pictures = page.parent / "figures"
    page.write_text("\n".join(part for cell in numbered(executed(path)) for part in shown(*cell, pictures)), encoding="utf-8")


def numbered(notebook: Any) -> Iterator[tuple[int, Any]]:
    """Yield the cells of a notebook with their numbers."""
    yield from enumerate(notebook.cells, 1)


def shown(number: int, cell: Any, pictures: Path) -> Iterator[str]:
    """Yield the Markdown of a cell; its pictures go into a folder."""
    if cell.cell_type == "markdown":
        yield f"{cell.source}\n"
        return
    yield f"```python\n{cell.source}\n```\n"
    for place, output in enumerate(cell.outputs, 1):
        yield from given(f"notebook_{number}_{place}", output, pictures)


def given(name: str, output: Any, pictures: Path) -> Iterator[str]:
    """Yield the Markdown of what a cell gave, in the richest of its forms."""
    data = output.get("data", {})
    if "image/png" in data:
        (pictures / f"{name}.png").write_bytes(base64.b64decode(data["image/png"]))
        size = output.metadata.get("image/png", {}).get("width")
        yield f"![what the cell draws](/_generated/figures/{name}.png)" + (f"{{width={size}px}}" if size else "") + "\n"
    elif "text/html" in data:
        yield f'```{{raw}} html\n<div class="shown">{data["text/html"]}</div>\n```\n'
    elif "text" in output or "text/plain" in data:
        yield f"```text\n{(output.get('text') or data['text/plain']).rstrip()}\n```\n"
