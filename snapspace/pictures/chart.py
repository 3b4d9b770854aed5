"""chart: curves over two logarithmic axes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import ceil, floor, hypot, log10
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from ..extras import need_extra

Point: TypeAlias = tuple[float, float]

_INK, _GRID, _PAPER = (58, 56, 54), (226, 224, 220), (255, 255, 255)
#: With the markers, distinct for colour-blind readers as well; a curve has one of each.
_COLORS = (
    (31, 95, 168),
    (200, 82, 36),
    (44, 132, 78),
    (120, 80, 150),
    (204, 121, 167),
    (86, 180, 233),
    (140, 100, 20),
    (230, 159, 0),
    (90, 90, 90),
    (0, 0, 0),
)
_CORNERS = (0, 4, 3, 5)  # of markers; 0 is a disc
#: Up to this many names are in the plot's corner; more are beside it.
_INSIDE = 4
#: Charts are drawn this many times larger and averaged, so that lines are smooth.
_FINER = 3


@dataclass(frozen=True)
class Curve:
    """Name and points of a curve: x and y (k,), all positive, and optional notes beside points.

    dashed : draws the line in dashes, for bounds and references
    """

    name: str
    x: Sequence[float]
    y: Sequence[float]
    notes: Sequence[str] = ()
    dashed: bool = False


def chart(
    curves: Sequence[Curve],
    *,
    title: str,
    x_name: str,
    y_name: str,
    size: tuple[int, int] = (560, 420),
) -> NDArray[np.uint8]:
    """Picture of curves with markers, axes, ticks at 1, 2 and 5 of each decade, and a legend.

    Parameters
    ----------
    curves : one to ten Curves
        With more than four, names are beside the plot.
    title, x_name, y_name : str
        Heading, and names of the axes with their units.
    size : (int, int), default (560, 420)
        Width and height in pixels.

    Returns
    -------
    ndarray, (height, width, 3) uint8
        Bitwise the same for the same input.

    Raises
    ------
    MissingExtraError
        A ValueError, if the extra `snapspace[pictures]` is not installed.
    ValueError
        For no curve or more than ten, points that are not positive and finite, or different
        numbers of x and y.
    """
    _check(curves)
    need_extra("pictures", who="chart")
    from PIL import Image

    paper = _Paper(size, curves)
    paper.frame(title, x_name, y_name)
    for number, curve in enumerate(curves):
        paper.curve(curve, number)
    paper.legend(curves)
    return np.asarray(paper.image.resize(size, Image.Resampling.BOX))


class _Paper:
    """An image with two axes."""

    def __init__(self, size: tuple[int, int], curves: Sequence[Curve]) -> None:
        from PIL import Image, ImageDraw, ImageFont

        width, height = (_FINER * length for length in size)
        self.image = Image.new("RGB", (width, height), _PAPER)
        self._pen = ImageDraw.Draw(self.image)
        self._text = round(0.03 * height)
        self._font = ImageFont.load_default(size=self._text)
        border = 3.2 * self._text
        widest = max(self._font.getlength(curve.name) for curve in curves)
        beside = widest + 3.5 * self._text if len(curves) > _INSIDE else 0.7 * border
        self._left, self._right = 1.9 * border, width - beside
        self._top, self._bottom = border, height - 1.3 * border
        self._x = _range([value for curve in curves for value in curve.x])
        self._y = _range([value for curve in curves for value in curve.y])

    def frame(self, title: str, x_name: str, y_name: str) -> None:
        """Grid, ticks and names."""
        pen, left, top, right, bottom = self._pen, self._left, self._top, self._right, self._bottom
        for value in _ticks(*self._x):
            x = self._place(value, 1.0)[0]
            pen.line([(x, top), (x, bottom)], fill=_GRID, width=_FINER)
            self._write((x, bottom + 0.4 * self._text), f"{value:g}", "ma")
        for value in _ticks(*self._y):
            y = self._place(1.0, value)[1]
            pen.line([(left, y), (right, y)], fill=_GRID, width=_FINER)
            self._write((left - 0.4 * self._text, y), f"{value:g}", "rm")
        pen.rectangle([left, top, right, bottom], outline=_INK, width=_FINER)
        self._write(((left + right) / 2, 0.9 * self._text), title, "ma")
        self._write(((left + right) / 2, bottom + 2.1 * self._text), x_name, "ma")
        self._write((0.5 * self._text, top - 1.5 * self._text), y_name, "la")

    def curve(self, curve: Curve, number: int) -> None:
        """A line with a marker and a note at each point."""
        points = [self._place(x, y) for x, y in zip(curve.x, curve.y, strict=True)]
        self._line(points, number, dashed=curve.dashed)
        for point in points:
            self._marker(point, number)
        for (x, y), note in zip(points, curve.notes, strict=False):
            after, above = 0.5 * self._text, 0.3 * self._text
            if x + after + self._font.getlength(note) < self._right:
                self._write((x + after, y - above), note, "ls")
            else:  # below the point, where a falling curve leaves space
                self._write((x - after, y + above), note, "ra")

    def legend(self, curves: Sequence[Curve]) -> None:
        """The names, each behind a line of its colour, in the lower left corner or beside."""
        inside = len(curves) <= _INSIDE
        x = (self._left if inside else self._right) + 0.7 * self._text
        for number, curve in enumerate(curves):
            below = self._bottom - (1.0 + 1.5 * (len(curves) - 1 - number)) * self._text
            y = below if inside else self._top + (0.7 + 1.5 * number) * self._text
            ends = [(x, y), (x + 1.5 * self._text, y)]
            self._line(ends, number, dashed=curve.dashed)
            self._marker((x + 0.75 * self._text, y), number)
            self._write((x + 2.0 * self._text, y), curve.name, "lm")

    def _line(self, points: Sequence[Point], number: int, *, dashed: bool) -> None:
        color, width = _COLORS[number], 2 * _FINER
        if len(points) > 1 and not dashed:
            self._pen.line(list(points), fill=color, width=width, joint="curve")
        if dashed:
            for start, end in pairwise(points):
                for dash in _dashes(start, end, 0.5 * self._text):
                    self._pen.line(dash, fill=color, width=width)

    def _marker(self, place: Point, number: int) -> None:
        corners, radius = _CORNERS[number % len(_CORNERS)], 3.5 * _FINER
        if corners:
            self._pen.regular_polygon((*place, 1.2 * radius), corners, fill=_COLORS[number])
        else:
            x, y = place
            box = [x - radius, y - radius, x + radius, y + radius]
            self._pen.ellipse(box, fill=_COLORS[number])

    def _place(self, x: float, y: float) -> tuple[float, float]:
        across = (log10(x) - self._x[0]) / (self._x[1] - self._x[0])
        up = (log10(y) - self._y[0]) / (self._y[1] - self._y[0])
        return (
            self._left + across * (self._right - self._left),
            self._bottom - up * (self._bottom - self._top),
        )

    def _write(self, place: tuple[float, float], text: str, anchor: str) -> None:
        self._pen.text(place, text, fill=_INK, font=self._font, anchor=anchor)


def _dashes(start: Point, end: Point, length: float) -> list[list[Point]]:
    """Pieces of a line, each as long as the gap after it."""
    (x, y), (to_x, to_y) = start, end
    count = max(round(hypot(to_x - x, to_y - y) / (2.0 * length)), 1)

    def at(share: float) -> Point:
        return x + share * (to_x - x), y + share * (to_y - y)

    return [[at(k / count), at((k + 0.5) / count)] for k in range(count)]


def _range(values: Sequence[float]) -> tuple[float, float]:
    """Decimal logarithms of the ends of an axis, which encloses the values with a margin."""
    lower, upper = log10(min(values)), log10(max(values))
    margin = max(0.08 * (upper - lower), 0.1)
    return lower - margin, upper + margin


def _ticks(lower: float, upper: float) -> list[float]:
    """1, 2 and 5 times powers of ten between two decimal logarithms; fewer over many decades."""
    factors = (1.0, 2.0, 5.0) if upper - lower < 2.5 else (1.0,)
    powers = range(floor(lower), ceil(upper) + 1)
    ticks = [float(f"{factor:g}e{power}") for power in powers for factor in factors]
    return [tick for tick in ticks if lower <= log10(tick) <= upper]


def _check(curves: Sequence[Curve]) -> None:
    if not 1 <= len(curves) <= len(_COLORS):
        raise ValueError(f"chart: got {len(curves)} curves, but it draws 1 to {len(_COLORS)}")
    for curve in curves:
        values = np.array([*curve.x, *curve.y], np.float64)
        if len(curve.x) != len(curve.y) or not len(curve.x):
            raise ValueError(
                f"chart: '{curve.name}' has {len(curve.x)} x and {len(curve.y)} y; give the same "
                "number of each, one or more"
            )
        if not (np.isfinite(values) & (values > 0)).all():
            raise ValueError(
                f"chart: '{curve.name}' has a value that is not positive and finite, so it has no "
                "place on a logarithmic axis"
            )
