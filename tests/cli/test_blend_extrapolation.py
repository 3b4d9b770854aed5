"""`snapspace blend --extrapolate` and `info` say how far out blends have a minimum."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from snapspace import InterpolationModel, load
from snapspace.problem import CertainRange

from .conftest import Run


def range_of(file: Path) -> CertainRange:
    model = load(file)
    assert isinstance(model, InterpolationModel) and model.certain_range is not None
    return model.certain_range


def weights_at(certain: CertainRange, share: float) -> str:
    """Weights at a share of the path from equal weights past pose 1 to the end of the range."""
    centre, direction = np.full(3, 1 / 3), np.eye(3)[1] - 1 / 3
    w = centre + share * certain.reach(centre + direction) * direction
    return ",".join(map(repr, w.tolist()))


def test_beyond_the_certain_range_there_is_a_notice(run: Run, blend_model: Path) -> None:
    certain = range_of(blend_model)
    words = ("blend", blend_model, "--extrapolate", "--json", "--weights")
    within = run(*words, weights_at(certain, 0.97))
    assert within.json["frames"][0]["certain"] is True
    assert "notice" not in within.err
    beyond = run(*words, weights_at(certain, 1.25))
    assert beyond.json["frames"][0]["certain"] is False
    text = " ".join(beyond.err.split())
    assert "the energy need not have a minimum there, and the shape may be poor" in text
    assert "up to 80 % of the way from equal weights it certainly has one" in text


def test_a_refusal_says_how_far_one_may_go(run: Run, blend_model: Path) -> None:
    error = run("blend", blend_model, "--weights", "30,-29,0", "--extrapolate").error
    share = 100 * range_of(blend_model).reach([30, -29, 0])
    assert error.endswith(f"up to {share:.3g} % of the way from equal weights it certainly has one")


def test_info_gives_the_range_for_every_pose(run: Run, blend_model: Path) -> None:
    result = run("info", blend_model, "--json")
    limits = range_of(blend_model).limits()
    text = " ".join(result.err.split())
    for pose, (least, greatest) in zip(result.json["poses"], limits, strict=True):
        assert pose["certain_weights"] == pytest.approx([least, greatest])
        assert f"weight certain from {100 * least:.0f} % to {100 * greatest:.0f} %" in text


def test_info_says_where_the_range_is_unknown(
    run: Run, blending_model: InterpolationModel, tmp_path: Path
) -> None:
    """It is unknown for St.Venant-Kirchhoff; no notice calls its blends uncertain either."""
    path = tmp_path / "poses.snapspace"
    blending_model.save(path)
    result = run("info", path, "--json")
    assert [pose["certain_weights"] for pose in result.json["poses"]] == [None] * 3
    text = " ".join(result.err.split())
    assert "how far below zero blends have a minimum is unknown for this material" in text
    beyond = run("blend", path, "--weights", "-0.1,1.1,0", "--extrapolate", "--json")
    assert beyond.json["frames"][0]["certain"] is None
    assert "notice" not in beyond.err
