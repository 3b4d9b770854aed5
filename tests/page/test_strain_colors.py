"""Colours by strain: the numbers are those of the surface, on both deformers."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import InterpolationModel, PosingModel

from .pages import OpenPage, Page

FloatArray = NDArray[np.float64]


def squares(rest: FloatArray, shape: FloatArray, faces: NDArray[np.int32]) -> FloatArray:
    """E : E of the triangles around each vertex, their mean by areas at rest."""
    edges = [x[faces[:, 1:]] - x[faces[:, :1]] for x in (rest, shape)]
    metrics = [e @ e.swapaxes(1, 2) for e in edges]
    strains = (np.linalg.solve(*metrics) - np.eye(2)) / 2
    own = np.einsum("tij,tji->t", strains, strains)
    areas = np.sqrt(np.linalg.det(metrics[0]))
    sums = np.zeros((2, len(rest)))
    for corner in faces.T:
        np.add.at(sums[0], corner, areas * own)
        np.add.at(sums[1], corner, areas)
    result: FloatArray = sums[0] / sums[1]
    return result


def strains(page: Page) -> FloatArray:
    """The strains that the vertex shader gets."""
    page.settle()
    return page.numbers("snapspace.strains()")


@pytest.mark.parametrize("query", ["", "?deform=cpu"])
def test_posing_strains(
    posing_model: PosingModel, posing_page: Path, opened: OpenPage, query: str
) -> None:
    page = opened(posing_page.as_uri() + query)
    page.page.get_by_role("radio", name="Strain").click()
    page.settle()
    assert np.abs(strains(page)).max() < 1e-6, "none at rest"
    page.drag(page.run("snapspace.handle(1)"), 60, -50)
    found = strains(page)
    mesh = posing_model.problem.mesh
    surface = mesh.surface_vertices
    faces = np.searchsorted(surface, mesh.surface)
    moved = page.shown()
    expected = np.sqrt(squares(mesh.vertices[surface], moved, faces))
    assert expected.max() > 0.03
    assert np.abs(found - expected).max() < 2e-3 * expected.max()
    # the scale covers nearly all of it, and has not grown far beyond
    assert page.text(".legend").startswith("Strain of the surface")
    end = "parseFloat(document.querySelectorAll('.legend div span')[2].textContent) / 100"
    page.wait(f"{end} > {np.quantile(expected, 0.8)}")  # it looks four times a second
    assert page.run(end) < 4 * expected.max()


def test_a_blend_has_the_mean_strain_of_its_poses(
    blending_model: InterpolationModel, blending_page: Path, opened: OpenPage
) -> None:
    page = opened(blending_page.as_uri())
    page.page.get_by_role("radio", name="Strain").click()
    first = page.page.locator("section", has_text="Poses").locator("input").nth(0)
    surface, problem = blending_model.surface, blending_model.problem
    for weight in (1.0, 0.4):
        first.fill(str(weight))
        weights = np.array([weight, *[(1 - weight) / 2] * 2])
        shape = page.shown()
        poses = [surface.vertices(pose.reshape(-1, 3)) for pose in problem.pose_shapes]
        parts = [squares(pose, shape, surface.faces) for pose in poses]
        areas = [areas_around(pose, surface.faces) for pose in poses]
        expected = sum(w * a * p for w, a, p in zip(weights, areas, parts, strict=True))
        expected /= sum(w * a for w, a in zip(weights, areas, strict=True))
        found = strains(page)
        assert np.abs(found - np.sqrt(expected)).max() < 5e-3 * max(p.max() for p in parts) ** 0.5
    assert expected.max() > 1e-3


def areas_around(rest: FloatArray, faces: NDArray[np.int32]) -> FloatArray:
    """Areas around the vertices."""
    a, b, c = (rest[corner] for corner in faces.T)
    areas = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    sums = np.zeros(len(rest))
    for corner in faces.T:
        np.add.at(sums, corner, areas)
    return sums
