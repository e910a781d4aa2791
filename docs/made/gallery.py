"""The gallery of the front page, and the list of the machines' pages."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from html import escape
from pathlib import Path

GROUPS = {
    "Machines at work": (
        "excavator", "hook_excavator", "telehandler", "wheel_loader", "loaded_front_loader", "forwarder", "tipper", "hoist_tipper",
        "tail_lift", "spreader_tractor", "plough_tractor",
        "levelled_telehandler", "axle", "crossed_axle",
        "digging_excavator", "braking_telehandler", "loading_forwarder",
        "pumped_excavator", "pumped_telehandler", "pumped_forwarder", "regenerative_press",
    ),
    "Hitches, lifts and headers": (
        "three_point_hitch", "hitch_category_1", "hitch_category_2", "mower_lift", "marked_mower_lift", "lowered_mower_lift",
        "header_balancer", "improved_balancer", "three_headers", "front_loader", "scissor_lift",
    ),
    "Cranes": (
        "crane", "bell_crank_crane", "direct_crane", "direct_crane_above", "chain_crane", "crane_skeleton", "back_broken_skeleton",
    ),
    "Drives of a crane": (
        "boom_drive", "arm_drive", "arm_drive_by_cylinder", "bell_crank_arm_drive", "bell_crank_arm_drive_by_cylinder",
        "angled_bell_crank_arm_drive", "direct_arm_drive", "direct_arm_drive_above",
    ),
    "Grapples": ("grapple", "inner_grapple", "crosshead_grapple"),
    "Four-bars": ("four_bar", "drag_link", "double_rocker", "triple_rocker", "parallelogram"),
    "Sliders and presses": ("slider_crank", "inverted_slider_crank", "scotch_yoke", "trammel", "toggle_press"),
    "Straight lines and copies": (
        "chebyshev", "hart", "hoeken", "pantograph", "peaucellier", "roberts", "roberts_cognates",
    ),
    "Six-bars": (
        "watt_one", "watt_two", "stephenson_one", "stephenson_two", "stephenson_two_far", "stephenson_three", "stephenson_three_far",
    ),
    "Walking legs": ("jansen", "klann"),
}  # fmt: skip
OTHERS = "Others"


def groups(names: Iterable[str]) -> dict[str, list[str]]:
    """Return machines by group, those that none names at the end."""
    there = list(names)
    found = {group: [name for name in wanted if name in there] for group, wanted in GROUPS.items()}
    grouped = {name for each in found.values() for name in each}
    found[OTHERS] = [name for name in there if name not in grouped]
    return {group: each for group, each in found.items() if each}


def make(titles: Mapping[str, tuple[str, str]], folder: Path) -> None:
    """Write the gallery and the list, from each machine's title and the first line of what it says of itself."""
    found = groups(titles)
    tiles, listed = [], ["# Machines\n", "Each page is made from the machine's own code when these pages are built.\n"]
    for group, names in found.items():
        tiles.append(f'<p class="gallery-group"><strong>{escape(group)}</strong></p>\n<div class="gallery">')
        tiles += [tile(name, titles[name][0]) for name in names]
        tiles.append("</div>\n")
        listed.append(f"\n## {group}\n")
        listed += [f"* {{doc}}`{titles[name][0]} </_generated/machines/{name}>`: {titles[name][1]}" for name in names]
    toctree = "\n".join(f"/_generated/machines/{name}" for names in found.values() for name in names)
    listed.append(f"\n```{{toctree}}\n:hidden:\n\n{toctree}\n```\n")
    (folder / "gallery.md").write_text("\n".join(tiles), encoding="utf-8")
    (folder / "machines.md").write_text("\n".join(listed), encoding="utf-8")


def tile(name: str, heading: str) -> str:
    """Return a machine's tile: its picture opens its live page, its name its own page."""
    picture = f'<a href="@live/{name}.html"><img src="@thumbs/{name}.png" alt="{escape(heading)}, live"></a>'
    return f'<figure>{picture}<figcaption><a href="@machines/{name}.html">{escape(heading)}</a></figcaption></figure>'
