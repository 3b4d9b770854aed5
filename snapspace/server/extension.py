"""Extension: chosen handles, with kept points as further handles."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..mesh import EmbeddedSurface
from ..problem import PosingProblem
from .kept_points import with_points
from .message_parts import HandleChoice, KeptPoint
from .selection import as_vector, choices_of
from .surface_regions import SurfaceRegions


@dataclass(frozen=True, kw_only=True)
class Extension:
    """A problem with further handles.

    problem : PosingProblem
    shown : all its handles, as the page shows them
    kept : the handles of the points, with their own bounds
    """

    problem: PosingProblem
    shown: tuple[HandleChoice, ...]
    kept: tuple[HandleChoice, ...]


def extension_of(
    problem: PosingProblem,
    points: Sequence[KeptPoint],
    surface: EmbeddedSurface,
    *,
    regions: SurfaceRegions | None,
    painted: Mapping[str, Sequence[int]],
) -> Extension:
    """The problem with points as further handles.

    Parameters
    ----------
    problem, points, surface : as for `with_points`, which raises the ValueErrors
    regions : SurfaceRegions or None
        The regions of the body's own surface, if it has one.
    painted : by the name of a handle, the vertices of that surface where it was painted
    """
    extended = with_points(problem, surface, points)
    choices = choices_of(extended)
    shown = choices if regions is None else regions.shown(choices, painted)
    bounds = dict(zip(extended.handles.names[1:], extended.domain.bounds, strict=True))
    names = {point.name for point in points}
    kept = tuple(_bounded(choice, bounds[choice.name]) for choice in shown if choice.name in names)
    return Extension(problem=extended, shown=shown, kept=kept)


def _bounded(choice: HandleChoice, bounds: np.ndarray) -> HandleChoice:
    """The choice with its own bounds, independent of those of other handles."""
    return replace(choice, translation=as_vector(bounds[:3]), angle=as_vector(bounds[3:]))
