"""FitCache: results are found again by the inputs that they were made from, and by no others."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from safetensors import safe_open
from safetensors.numpy import save_file

from snapspace import TetMesh
from snapspace.cli.fit_cache import FitCache
from snapspace.fitting import PoseFit
from snapspace.mesh import boundary_surface
from snapspace.snapshots import CheckpointNotice

from .files import bar_mesh, bar_shapes, contents

MESH = bar_mesh()
SURFACE = boundary_surface(MESH)
SHAPE = bar_shapes()["bent"]
TARGET = SURFACE.vertices(SHAPE)
SETTINGS = {"deviation": 1e-3}
FIT = PoseFit(
    name="bent",
    rms=1 / 3,
    max=0.7,
    inverted_tets=0,
    smallest_stretch=0.1,
    largest_stretch=1.5,
    stages=4,
    iterations=30,
    seconds=0.25,
    status="converged",
)


@pytest.fixture
def cache(tmp_path: Path) -> FitCache:
    return FitCache.beside(tmp_path / "m.snapspace")


def keep(cache: FitCache) -> None:
    cache.save_tets(TARGET, SURFACE.faces, {}, MESH)
    cache.save_fit(MESH, SURFACE, TARGET, SETTINGS, SHAPE, FIT)


def test_kept_results_come_back_bit_by_bit(cache: FitCache) -> None:
    keep(cache)
    mesh = cache.load_tets(TARGET, SURFACE.faces, {})
    assert mesh is not None
    assert mesh.fingerprint == MESH.fingerprint
    fitted = cache.load_fit(MESH, SURFACE, TARGET, SETTINGS)
    assert fitted is not None
    np.testing.assert_array_equal(fitted[0], SHAPE)
    assert fitted[1] == FIT


def test_an_empty_cache_has_nothing_and_leaves_no_folder(cache: FitCache) -> None:
    assert cache.load_tets(TARGET, SURFACE.faces, {}) is None
    assert cache.load_fit(MESH, SURFACE, TARGET, SETTINGS) is None
    cache.remove()
    assert not cache.folder.exists()


def test_another_surface_or_size_is_filled_anew(cache: FitCache) -> None:
    keep(cache)
    other = TARGET.copy()
    other[3, 1] = np.nextafter(other[3, 1], 9)
    assert cache.load_tets(other, SURFACE.faces, {}) is None
    assert cache.load_tets(TARGET, SURFACE.faces[::-1], {}) is None
    assert cache.load_tets(TARGET, SURFACE.faces, {"edge_length": 0.02}) is None


def test_a_change_of_any_input_asks_for_a_new_fit(cache: FitCache) -> None:
    keep(cache)
    target = TARGET.copy()
    target[3, 1] = np.nextafter(target[3, 1], 9)
    moved = TetMesh(MESH.vertices + 1.0, MESH.tets)
    corners = SURFACE.corners.copy()
    corners[[0, 1]] = corners[[1, 0]]
    changes: list[tuple[Any, ...]] = [
        (moved, SURFACE, TARGET, SETTINGS),
        (MESH, replace(SURFACE, corners=corners), TARGET, SETTINGS),
        (MESH, replace(SURFACE, faces=SURFACE.faces[1:]), TARGET, SETTINGS),  # areas
        (MESH, SURFACE, target, SETTINGS),
        (MESH, SURFACE, TARGET, {"deviation": 2e-3}),
    ]
    for change in changes:
        assert cache.load_fit(*change) is None


def truncated(path: Path) -> None:
    path.write_bytes(path.read_bytes()[:-9])


def cut_in_the_header(path: Path) -> None:
    path.write_bytes(path.read_bytes()[:20])


def emptied(path: Path) -> None:
    path.write_bytes(b"")


def one_bit_flipped(path: Path) -> None:
    """A bit of the last array: the layout stays the same, and a number changes a little."""
    content = bytearray(path.read_bytes())
    content[-4] ^= 1
    path.write_bytes(content)


def without_a_checksum(path: Path) -> None:
    """A file from before files had checksums."""
    with safe_open(path, framework="np") as file:
        arrays = {name: file.get_tensor(name) for name in file.keys()}
        words = {k: v for k, v in file.metadata().items() if k != "crc32"}
    save_file(arrays, path, words)


def something_else(path: Path) -> None:
    path.write_bytes(b"solid cube\n" * 50)


def of_another_program(path: Path) -> None:
    save_file({"numbers": np.arange(3)}, path, {"fit": '{"unknown": 1}'})


def with_another_report(path: Path) -> None:
    """A file from a version whose reports have other entries."""
    save_file({"shape": SHAPE, "vertices": 0 * SHAPE, "tets": MESH.tets}, path, {"fit": "{}"})


DAMAGES = (
    truncated,
    one_bit_flipped,
    without_a_checksum,
    cut_in_the_header,
    emptied,
    something_else,
    of_another_program,
    with_another_report,
)


@pytest.mark.parametrize("damage", DAMAGES, ids=lambda damage: damage.__name__)
def test_damaged_files_are_reported_and_made_again(cache: FitCache, damage: Any) -> None:
    keep(cache)
    for path in list(cache.folder.iterdir()):
        damage(path)
    with pytest.warns(CheckpointNotice, match=r"tets-\w+.*not used \(.*\); the surface is filled "):
        assert cache.load_tets(TARGET, SURFACE.faces, {}) is None
    with pytest.warns(CheckpointNotice, match=r"pose-\w+.*not used \(.*\); its pose is fitted "):
        assert cache.load_fit(MESH, SURFACE, TARGET, SETTINGS) is None
    keep(cache)  # made again, over the damaged one
    assert cache.load_tets(TARGET, SURFACE.faces, {}) is not None
    assert cache.load_fit(MESH, SURFACE, TARGET, SETTINGS) is not None


def test_a_missing_file_gives_no_notice(cache: FitCache) -> None:
    keep(cache)
    for path in list(cache.folder.iterdir()):
        path.unlink()
    assert cache.load_tets(TARGET, SURFACE.faces, {}) is None
    assert cache.load_fit(MESH, SURFACE, TARGET, SETTINGS) is None


def test_a_file_that_belongs_to_another_pose_is_not_used(cache: FitCache) -> None:
    keep(cache)
    other = TARGET + 0.01
    cache.save_fit(MESH, SURFACE, other, SETTINGS, 2.0 * SHAPE, FIT)
    first, second = sorted(cache.folder.glob("pose-*"))
    first.write_bytes(second.read_bytes())
    with pytest.warns(CheckpointNotice, match="it was made from other inputs"):
        found = [cache.load_fit(MESH, SURFACE, target, SETTINGS) for target in (TARGET, other)]
    assert found.count(None) == 1


def test_it_is_beside_the_output_and_leaves_nothing_behind(cache: FitCache, tmp_path: Path) -> None:
    (tmp_path / "m.snapspace").write_text("the model")
    keep(cache)
    assert len(contents(tmp_path)) == 3
    assert cache.folder.parent == tmp_path
    cache.remove()
    assert [path.name for path in tmp_path.iterdir()] == ["m.snapspace"]


def test_files_of_the_user_in_its_folder_stay(cache: FitCache) -> None:
    keep(cache)
    (cache.folder / "rest.msh").write_text("saved by the user")
    cache.remove()
    assert [path.name for path in cache.folder.iterdir()] == ["rest.msh"]


def test_a_folder_that_cannot_be_made_is_an_error(cache: FitCache) -> None:
    cache.folder.write_text("a file")
    with pytest.raises(
        ValueError, match=r"m\.snapspace\.poses: cannot create the folder"
    ) as caught:
        keep(cache)
    assert "\n" not in str(caught.value)
