"""The grapple's figures, one call each: `figure("stems")`. They load matplotlib, and are loaded when one is drawn.

"stems" is the grapple open, at the largest and at the smallest stem, with the rosette of stems that rest on T. "moments" is what
its lever gives and what the stems need, over their diameter.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Circle
from matplotlib.transforms import Affine2D

from linkage import deg, draw, mm, ref
from linkage.pictures import style
from linkage.pictures.scene import Scene
from linkage.pictures.sheet import sheet

from ..sheets import CURVES, axis_words, curve, headed, marked_place, titled
from .machine import Grapple
from .report import GrappleState, gripping, moment_ratio, require_placed, travelling

STEMS = 5
"""Stems of the rosette, the largest and the smallest among them."""
WOOD = ("#e9dcc3", "#b59a6a")
"""A stem's face and its bark."""
SIZES = {"bore": "bore", "rod": "rod", "stroke": "S"}
"""The numbers of the cylinder by their words."""


# -- three positions with the rosette of stems -------------------------------------------------------------


def stems(grapple: Grapple) -> Figure:
    """Return the grapple open, at D_0 and at d_0, the other lever faint, with the rosette of stems resting on T."""
    way = travelling(require_placed(grapple.at(theta=0.0)), 41)
    start, end = (float(way.strokes["theta"][place]) for place in (0, -1))
    left, right, low, high = Scene(way).box()
    right = max(-left, right)
    large, small = (float(grapple[name]) for name in ("D_0", "d_0"))
    size = ", ".join(f"{word} {float(np.ravel(way.value(ref(name)))[0]) / mm:.0f}" for word, name in SIZES.items())
    title = f"The grapple and its stems, {small / mm:.0f} to {large / mm:.0f} mm; cylinder, mm: {size}"
    shape = 14.4, 1.2 + 2.3 * (high - low) / right
    page, axes = titled(title, shape, 3, rect=(0.005, 0.0, 0.99, 0.985), w_pad=0.06, h_pad=0.06)
    motion = grapple.at(theta=[start, 0.0, end])
    for pose, (ax, theta, title) in enumerate(zip(axes, (start, 0.0, end), ("open", "largest stem", "smallest stem"), strict=True)):
        sheet(ax, (-right, right, low, high))
        D = float(motion["D"][pose])
        for stem in np.linspace(large, small, STEMS):
            is_held = theta <= 0.0 and abs(stem - D) < 1e-9
            line = {"edgecolor": WOOD[1], "linewidth": 1.6 if is_held else 0.8, "linestyle": "-" if is_held else (0, (5, 3))}
            face, level = (WOOD[0], 2.5) if is_held else ("none", 3.0)
            ax.add_patch(Circle((0.0, 0.5 * (large - stem)), 0.5 * stem, facecolor=face, zorder=level, **line))
        known = ax.get_children()
        draw(motion, ax=ax, pose=pose, faint=True)
        for artist in ax.get_children():
            if artist not in known:  # the other lever stands across the y axis
                artist.set_transform(Affine2D().scale(-1.0, 1.0) + ax.transData)
        draw(motion, ax=ax, pose=pose)
        held = "" if theta > 0.0 else f", D = {D / mm:.0f} mm"
        text = f"{title}{held}: theta = {theta / deg:.1f} deg".replace("-", "\N{MINUS SIGN}")
        headed(ax, text)
    return page


# -- moments over the diameter -----------------------------------------------------------------------------


def moments(grapple: Grapple) -> Figure:
    """Return M_g and M_1 over the stem's diameter, and below them their ratio."""
    over = gripping(require_placed(grapple.at(theta=0.0)), 201)
    state, ratio = GrappleState(over), moment_ratio(over)
    stems_held = f"stems of {float(grapple['d_0']) / mm:.0f} to {float(grapple['D_0']) / mm:.0f} mm"
    title = f"Moments of one lever over {stems_held}"
    page, (above, below) = titled(title, (8.4, 7.2), 1, 2, rect=(0.005, 0.005, 0.985, 0.985), h_pad=0.08)
    D = state.D / mm
    above.fill_between(D, state.needed / 1e3, state.given / 1e3, color=style.CURVE, alpha=0.12, linewidth=0)
    curve(above, D, state.given / 1e3, style.CURVE, "M_g, what the lever gives")
    curve(above, D, state.needed / 1e3, style.ACCENT, "M_1, what the stem needs")
    above.set_ylim(0.0, None)
    above.legend(loc="upper left", **CURVES)
    for ax in (above, below):
        ax.set_xlim(float(D.min()), float(D.max()))
    curve(below, D, ratio, style.INK)
    below.axhline(1.0, color=style.ACCENT, linewidth=1.2, linestyle="--")
    below.set_ylim(min(0.9, 0.95 * float(ratio.min())), None)
    for place, word in ((int(np.argmin(ratio)), "least"), (int(np.argmax(ratio)), "greatest")):
        marked_place(below, float(D[place]), float(ratio[place]), f"{word} {ratio[place]:.3f} at {D[place]:.0f} mm")
    axis_words(above, "", "moment about the hinge, kNm")
    axis_words(below, "diameter of the stem, mm", "M_g / M_1")
    return page


DRAWN: Mapping[str, Callable[[Grapple], Figure]] = MappingProxyType({"stems": stems, "moments": moments})
