"""Ctrl-C keeps the finished poses; progress reports every pose."""

from __future__ import annotations

import numpy as np
import pytest

from snapspace import interruptible
from snapspace.fitting import PoseFit, fit_poses

from .bodies import bent, body

MESH, SURFACE = body()
REST = SURFACE.vertices(MESH.vertices)
TARGETS = [bent(REST, angle) for angle in (0.5, 1.0, 1.5, 2.0, 2.5, 3.0)]


@pytest.fixture(autouse=True)
def quick_polls(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(interruptible, "POLL_SECONDS", 0.002)


def test_every_pose_is_announced_once() -> None:
    seen: dict[int, tuple[np.ndarray, PoseFit]] = {}
    counts: list[tuple[int, int]] = []

    def keep(index: int, shape: np.ndarray, report: PoseFit) -> None:
        assert index not in seen
        seen[index] = shape, report

    fits = fit_poses(
        MESH, SURFACE, TARGETS, on_finished=keep, progress=lambda *count: counts.append(count)
    )
    assert sorted(seen) == list(range(len(TARGETS)))
    for index, (shape, report) in seen.items():
        np.testing.assert_array_equal(shape, fits.shapes[index])
        assert report is fits.reports[index]
    assert counts == sorted(counts) and counts[-1] == (len(TARGETS), len(TARGETS))


def test_ctrl_c_keeps_finished_poses() -> None:
    targets = TARGETS * 10  # a second, so that a busy machine polls before all are finished
    kept: dict[int, np.ndarray] = {}

    def progress(done: int, total: int) -> None:
        if done:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt, match=f"of {len(targets)} poses are finished"):
        fit_poses(
            MESH,
            SURFACE,
            targets,
            threads=1,
            progress=progress,
            on_finished=lambda index, shape, report: kept.update({index: shape}),
        )
    assert 0 < len(kept) < len(targets)
    for index, shape in kept.items():
        whole = fit_poses(MESH, SURFACE, targets[index : index + 1])
        np.testing.assert_array_equal(shape, whole.shapes[0])


def test_an_error_of_the_callback_ends_the_fit() -> None:
    def full(index: int, shape: np.ndarray, report: PoseFit) -> None:
        raise OSError("no space left")

    with pytest.raises(OSError, match="no space left"):
        fit_poses(MESH, SURFACE, TARGETS, on_finished=full)


def test_ctrl_c_in_the_callback_loses_no_finished_pose() -> None:
    """The pose whose call was interrupted is offered again, then finished poses not yet offered."""
    offered: list[int] = []
    kept: dict[int, np.ndarray] = {}

    def keep(index: int, shape: np.ndarray, report: PoseFit) -> None:
        offered.append(index)
        if len(offered) == 2:  # before this one is kept
            raise KeyboardInterrupt
        kept[index] = shape

    with pytest.raises(KeyboardInterrupt, match=f"of {len(TARGETS)} poses are finished") as caught:
        fit_poses(MESH, SURFACE, TARGETS, threads=1, on_finished=keep)
    assert str(caught.value).startswith(f"{len(kept)} of ")
    interrupted = offered[1]
    assert offered.count(interrupted) == 2 and interrupted in kept
    assert sorted(offered) == sorted([*kept, interrupted]), "all others are offered once"
    whole = fit_poses(MESH, SURFACE, TARGETS[interrupted : interrupted + 1])
    np.testing.assert_array_equal(kept[interrupted], whole.shapes[0])
