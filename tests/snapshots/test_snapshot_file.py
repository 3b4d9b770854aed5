"""Files of snapshots are read bit by bit, for the same problem, and refused if damaged."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from snapspace import (
    InterpolationModel,
    PosingModel,
    Snapshots,
    load,
    load_snapshots,
    save_snapshots,
    validate,
)


def written(snapshots: Snapshots, folder: Path) -> Path:
    return save_snapshots(snapshots.select(np.arange(60) < 4), folder / "bar.samples")


def test_everything_is_read_again(posing_snapshots: Snapshots, tmp_path: Path) -> None:
    path = written(posing_snapshots, tmp_path)
    found, few = load_snapshots(path, posing_snapshots.problem), np.arange(60) < 4
    np.testing.assert_array_equal(found.parameters, posing_snapshots.parameters[few])
    np.testing.assert_array_equal(found.shapes, posing_snapshots.shapes[few])
    assert found.reports == list(posing_snapshots.reports[:4])
    assert list(tmp_path.iterdir()) == [path], "no temporary file is left"
    content = path.read_bytes()
    assert written(posing_snapshots, tmp_path).read_bytes() == content


@pytest.mark.parametrize("name", ["posing_model", "blending_model"])
def test_loaded_snapshots_judge_a_loaded_model(
    name: str, request: pytest.FixtureRequest, tmp_path: Path
) -> None:
    """That works even if the mean shape, from which displacements count, was loaded too."""
    model: PosingModel | InterpolationModel = request.getfixturevalue(name)
    checked = validate(model, samples=3, threads=1)
    path = save_snapshots(checked.reference, tmp_path / "reference.samples")
    again = load(model.save(tmp_path / "m.snapspace"))
    known = validate(again, reference=load_snapshots(path, again.problem))
    np.testing.assert_allclose(known.error, checked.error, rtol=1e-9)


def test_samples_of_another_problem_are_refused(
    posing_snapshots: Snapshots, blending_model: InterpolationModel, tmp_path: Path
) -> None:
    path = written(posing_snapshots, tmp_path)
    with pytest.raises(ValueError, match=r"bar\.samples: these samples are of another problem"):
        load_snapshots(path, blending_model.problem)


@pytest.mark.parametrize("position", [40, 300, -9])
def test_a_damaged_file_is_refused(
    posing_snapshots: Snapshots, tmp_path: Path, position: int
) -> None:
    path = written(posing_snapshots, tmp_path)
    content = bytearray(path.read_bytes())
    content[position] ^= 1
    path.write_bytes(content)
    with pytest.raises(ValueError, match=r"bar\.samples: (not a|its content has changed)"):
        load_snapshots(path, posing_snapshots.problem)
    path.write_bytes(content[: len(content) // 2])
    with pytest.raises(ValueError, match="not a complete samples file"):
        load_snapshots(path, posing_snapshots.problem)


def test_other_files_are_refused(
    posing_model: PosingModel, posing_snapshots: Snapshots, tmp_path: Path
) -> None:
    other = posing_model.save(tmp_path / "m.snapspace").rename(tmp_path / "m.samples")
    with pytest.raises(ValueError, match="not a samples file of this version"):
        load_snapshots(other, posing_model.problem)
    with pytest.raises(ValueError, match="there is no such file"):
        load_snapshots(tmp_path / "none.samples", posing_model.problem)
    with pytest.raises(ValueError, match=r"\.samples"):
        save_snapshots(posing_snapshots, tmp_path / "bar.npz")
    with pytest.raises(ValueError, match="there is no folder"):
        save_snapshots(posing_snapshots, tmp_path / "no" / "bar.samples")
