"""Pictures and films of surfaces, and charts, drawn in NumPy: no display, no GPU."""

from __future__ import annotations

from .chart import Curve, chart
from .colormap import colormap, tint
from .film import FILMS, save_film
from .render import render
from .row import render_row
from .save import save_png

__all__ = [
    "FILMS",
    "Curve",
    "chart",
    "colormap",
    "render",
    "render_row",
    "save_film",
    "save_png",
    "tint",
]
