"""check_surface: what is wrong with a surface, what that means, and what to do."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..mesh.closed_surface import enclosed_volume, is_flat
from ..mesh.edges import edges_of
from ..mesh.surface_file.surface_file import checked_surface
from .cleaned import cleaned
from .edge_findings import copy_findings, edge_findings
from .finding import Finding
from .holes import has_wide_hole
from .shape_findings import (
    crossing_finding,
    face_areas,
    flat_finding,
    place_finding,
    sliver_finding,
    thin_finding,
)


@dataclass(frozen=True, kw_only=True)
class SurfaceReport:
    """What `check_surface` found.

    vertices, faces : their numbers
    bounds : two corners of the bounding box
    diagonal : of the bounding box
    area : of all faces without duplicates
    volume : enclosed volume, negative if faces are inward; None if the surface is not closed
    findings : faults first
    """

    vertices: int
    faces: int
    bounds: tuple[tuple[float, ...], tuple[float, ...]]
    diagonal: float
    area: float
    volume: float | None
    findings: tuple[Finding, ...]

    @property
    def closed(self) -> bool:
        """Whether the surface encloses a solid: no holes, and faces oriented consistently."""
        return self.volume is not None

    @property
    def fine(self) -> bool:
        """Whether nothing needs mending."""
        return not any(finding.fault for finding in self.findings)

    def as_json(self) -> dict[str, Any]:
        """All fields."""
        return {
            "fine": self.fine,
            "closed": self.closed,
            "vertices": self.vertices,
            "faces": self.faces,
            "bounds": [list(corner) for corner in self.bounds],
            "diagonal": self.diagonal,
            "area": self.area,
            "volume": self.volume,
            "findings": [finding.as_json() for finding in self.findings],
        }


def check_surface(vertices: ArrayLike, faces: ArrayLike) -> SurfaceReport:
    """Examines a triangle surface before it is filled.

    Looks for holes, edges of more than two faces, inconsistent orientation, inward faces,
    degenerate, duplicate and intersecting faces, several components, seams, unused vertices,
    slivers, thin parts, and a position far from the origin.

    Parameters
    ----------
    vertices : array_like, (n, 3)
    faces : array_like of int, (f, 3)

    Returns
    -------
    SurfaceReport
        It does not depend on the unit of length. Vertices with equal positions count as one if the
        surface is closed only then, or if faces coincide.

    Raises
    ------
    ValueError
        For wrong shapes or types, no faces, coordinates that are not finite, or an index out of
        range.
    """
    points, triangles = checked_surface(vertices, faces, who="check_surface")
    used = np.zeros(len(points), np.bool_)
    used[triangles] = True
    low, high = points[used].min(axis=0), points[used].max(axis=0)
    center, diagonal = (low + high) / 2.0, float(np.linalg.norm(high - low))
    scaled = (points - center) / (diagonal or 1.0)  # thresholds are for diagonal one
    clean = cleaned(scaled, triangles)
    findings = copy_findings(clean, int((~used).sum()))
    areas, shapes = face_areas(scaled, clean.faces)
    area = float(areas.sum())
    volume = None
    flat = not len(clean.faces) or is_flat(scaled, clean.faces)
    if flat:
        open_sheet = len(clean.faces) > 0 and has_wide_hole(scaled, clean.faces)
        findings.append(flat_finding(sheet=open_sheet))
    if len(clean.faces):
        edges = edges_of(clean.faces)
        found = edge_findings(points, clean.faces, edges)
        findings += [one for one in found if not (flat and one.name == "holes")]
        if not edges.balance.any():
            volume = enclosed_volume(scaled, clean.faces)
            findings += _inward(volume)
            findings += [] if flat else thin_finding(volume, area, 1.0)
        findings += crossing_finding(scaled, clean.faces)
    findings += sliver_finding(shapes) + place_finding(center, diagonal or 1.0)
    return SurfaceReport(
        vertices=len(points),
        faces=len(triangles),
        bounds=(tuple(low.tolist()), tuple(high.tolist())),
        diagonal=diagonal,
        area=area * diagonal**2,
        volume=None if volume is None else volume * diagonal**3,
        findings=tuple(sorted(findings, key=lambda finding: not finding.fault)),
    )


def _inward(volume: float) -> list[Finding]:
    if volume >= -1e-12:
        return []
    return [
        Finding(
            name="inward",
            fault=False,
            count=1,
            text="all faces are oriented inward",
            meaning="filling flips them; other programs may draw them dark",
            cure="nothing; --fix flips them",
            mended=True,
        )
    ]
