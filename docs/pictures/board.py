"""Draw the picture of docs/board.md: `python docs/pictures/board.py`, into docs/images. It is the board in a browser."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory

from linkage.board import drawing_board
from linkage.sketch import MachineSketch, SketchDrive

IMAGES = Path(__file__).parents[1] / "images"
LOADER = MachineSketch(
    "Loader",
    {
        "O": (0.0, 1.2), "A": (0.35, 0.45), "B": (0.95, 0.95), "C": (2.0, 0.55), "D": (2.05, 0.95), "T": (2.6, 0.4), "K": (0.3, 1.55),
    },
    ("O", "A", "K"),
    {"boom": ("O", "B", "C"), "bucket": ("C", "D", "T")},
    drives={"lift": SketchDrive("cylinder", ("A", "B"), 0.0, 0.45), "tilt": SketchDrive("cylinder", ("K", "D"), 0.0, 0.4)},
)  # fmt: skip


class Screenshot:
    """The board as a browser shows it; where none is installed, the picture that is kept."""

    def savefig(self, path: Path, metadata: object = None) -> None:
        """Write it as PNG."""
        browser = shutil.which("chromium")
        if browser is None:
            shutil.copy(IMAGES / "board.png", path)
            return
        from playwright.sync_api import sync_playwright

        with TemporaryDirectory() as folder, sync_playwright() as playwright:
            place = drawing_board(LOADER, Path(folder) / "board.html")
            opened = playwright.chromium.launch(executable_path=browser, args=["--no-sandbox"])
            tab = opened.new_page(viewport={"width": 1200, "height": 760})
            tab.goto(place.as_uri())
            tab.get_by_role("button", name="Path", exact=True).click()
            tab.keyboard.press("Escape")
            tab.locator("#parts").get_by_role("button", name="T", exact=True).click()
            tab.locator("#fields").get_by_label("Path").check()
            tab.locator("#parts").get_by_role("button", name="lift", exact=True).click()
            tab.locator("#whole").click()
            tab.wait_for_timeout(8000)
            tab.screenshot(path=path)
            opened.close()


PICTURES: dict[str, Callable[[], Screenshot]] = {"board": Screenshot}

if __name__ == "__main__":
    for name, make in PICTURES.items():
        make().savefig(IMAGES / f"{name}.png")
