"""Pictures: a mechanism at a pose, at its end positions, in motion, and curves of results over the stroke.

What draws and the live page are loaded when they are first asked for: one brings Matplotlib, the other studies and syntheses.
"""

from ..star import late_names

__getattr__, __dir__ = late_names(globals())
