"""`interpolate --tets` with a box several times as large as the surface inside it."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from snapspace import TetMesh, read_surface, write_tets
from snapspace.fitting.targets import point_areas, registered_targets
from snapspace.generators import bar

from .conftest import Run
from .files import FloatArray, bar_surfaces, write_surface_poses


def loose_box() -> TetMesh:
    """A box of thirteen times the bar's volume, with the bar in its middle."""
    box = bar(18, 9, 9, length=6.0, width=3.0, height=3.0)
    return TetMesh(box.vertices - 1.0, box.tets)


def rms(shape: FloatArray, target: FloatArray, areas: FloatArray) -> float:
    """Distance of surfaces after registration, weighted by area."""
    away = registered_targets(shape[None], target, areas)[0] - target
    return float(np.sqrt(areas @ (away**2).sum(axis=1) / areas.sum()))


def test_a_loose_cage_gives_the_surfaces_back(run: Run, tmp_path: Path) -> None:
    write_tets(tmp_path / "box.mesh", loose_box())
    path, out = tmp_path / "m.snapspace", tmp_path / "out.ply"
    files = write_surface_poses(tmp_path)[:2]
    # the subspace contains all snapshots, so poses are as far off as their fits
    words = ("--tets", tmp_path / "box.mesh", "--samples", 4, "--dimension", 6, "-o", path)
    figures = run("interpolate", *files, *words, "--json").json
    (fit,) = figures["fits"]
    assert (fit["status"], fit["inverted_tets"]) == ("converged", 0)
    assert figures["tets"] == len(loose_box().tets)
    surfaces = [bar_surfaces()[name] for name in ("rest", "bent")]
    for weights, (wanted, faces), reported in zip(
        ("1,0", "0,1"), surfaces, (0.0, fit["rms"]), strict=True
    ):
        assert run("blend", path, "--weights", weights, "-o", out).code == 0
        vertices, found = read_surface(out)
        np.testing.assert_array_equal(found, faces)
        away = rms(vertices, wanted, point_areas(wanted, faces)) / loose_box().diagonal
        assert abs(away - reported) < 2e-5
