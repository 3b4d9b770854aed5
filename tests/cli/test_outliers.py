"""Builds name motions that are far off although the median error is small."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from snapspace.cli import outliers
from snapspace.cli.outliers import notice_outliers


def told(
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
    worst: float,
    projection: float,
    *,
    snaps: bool = True,
) -> str:
    """The notice about fifteen motions with an error of 0.2 % and one with the worst."""
    errors, projections = np.full(16, 0.002), np.full(16, 0.0005)
    errors[3], projections[3] = worst, projection
    validation = SimpleNamespace(error=errors, projection_error=projections, reference=None)
    monkeypatch.setattr(outliers, "other_minima", lambda _, __, which: np.full(len(which), snaps))
    notice_outliers(None, validation)  # type: ignore[arg-type]
    return " ".join(capsys.readouterr().err.split())


def test_another_minimum_is_distinguished_from_a_poor_subspace(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    snapped = told(capsys, monkeypatch, worst=0.9, projection=0.001)
    assert "1 of 16 unseen motions are more than 10 % off, at most 90 %, at another" in snapped
    assert snapped.endswith("or put a handle on the part that buckles")
    poor = told(capsys, monkeypatch, worst=0.9, projection=0.5)
    assert "minimum" not in poor and "give a smaller --target-error" in poor


def test_a_stiff_subspace_is_not_another_minimum(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """The subspace contains the solution, but a solve beside it ends at the frame."""
    stiff = told(capsys, monkeypatch, worst=0.9, projection=0.001, snaps=False)
    assert "minimum" not in stiff and "give a smaller --target-error" in stiff


def test_errors_of_usual_size_are_not_reported(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    assert told(capsys, monkeypatch, worst=0.15, projection=0.001) == ""
    assert told(capsys, monkeypatch, worst=0.002, projection=0.0005) == ""
