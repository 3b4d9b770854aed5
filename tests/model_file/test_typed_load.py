"""load_posing and load_blending load one kind; the error for the other names its function."""

from __future__ import annotations

from pathlib import Path

import pytest

from snapspace import InterpolationModel, PosingModel, load_blending, load_posing


def test_each_takes_its_own_kind_and_names_the_other(
    posing_model: PosingModel, blending_model: InterpolationModel, tmp_path: Path
) -> None:
    posing = posing_model.save(tmp_path / "posing.snapspace")
    blending = blending_model.save(tmp_path / "blending.snapspace")
    assert isinstance(load_posing(posing), PosingModel)
    assert isinstance(load_blending(blending), InterpolationModel)
    with pytest.raises(ValueError, match=r"blends poses .* read it with load_blending"):
        load_posing(blending)
    with pytest.raises(ValueError, match=r"has handles .* read it with load_posing"):
        load_blending(posing)
    with pytest.raises(ValueError, match="there is no such model file"):
        load_posing(tmp_path / "none.snapspace")
