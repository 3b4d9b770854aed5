"""Fitted poses: made once, the same when they are read again."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import paper.fitted
import snapspace as ss
from paper.fitted import fitted_poses
from snapspace.generators import bar
from snapspace.mesh import compact_surface

MESH = bar(4, 2, 2, length=4.0)


def test_fits_are_made_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    tets, rest = tmp_path / "bar.mesh", tmp_path / "rest.off"
    ss.write_tets(tets, MESH)
    bent = MESH.vertices + np.array([0.0, 0.0, 0.05]) * MESH.vertices[:, :1] ** 2
    for name, vertices in (("rest", MESH.vertices), ("bent", bent)):
        surface = compact_surface(vertices, MESH.surface)
        ss.write_surface(tmp_path / f"{name}.off", *surface)
    first = fitted_poses(tets, rest, ("bent",), folder=tmp_path / "fits")
    shape = first.poses.shapes[1]
    assert first.poses.names == ("rest", "bent") and first.seconds > 0
    moved = np.linalg.norm(shape - MESH.vertices, axis=1).max()
    assert moved > 0.1, "the free end moves by 0.8, most of it a rigid motion"
    assert first.poses.inverted_tets.sum() == 0

    monkeypatch.setattr(paper.fitted, "fit_poses", None)  # nothing is fitted again
    again = fitted_poses(tets, rest, ("bent",), folder=tmp_path / "fits")
    assert np.array_equal(again.poses.shapes, first.poses.shapes)
    assert again.seconds == first.seconds
