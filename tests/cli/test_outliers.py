"""Builds name motions that are far off although the median error is small."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from snapspace.cli.outliers import notice_outliers


def told(capsys: pytest.CaptureFixture[str], worst: float, projection: float) -> str:
    """The notice about fifteen motions with an error of 0.2 % and one with the worst."""
    errors, projections = np.full(16, 0.002), np.full(16, 0.0005)
    errors[3], projections[3] = worst, projection
    validation = SimpleNamespace(error=errors, projection_error=projections)
    notice_outliers(validation)  # type: ignore[arg-type]
    return " ".join(capsys.readouterr().err.split())


def test_another_minimum_is_distinguished_from_a_poor_subspace(
    capsys: pytest.CaptureFixture[str],
) -> None:
    snapped = told(capsys, worst=0.9, projection=0.001)
    assert "1 of 16 unseen motions are more than 10 % off, at most 90 %, probably at an" in snapped
    assert snapped.endswith("or put a handle on the part that buckles")
    poor = told(capsys, worst=0.9, projection=0.5)
    assert "minimum" not in poor and "give a smaller --target-error" in poor


def test_errors_of_usual_size_are_not_reported(capsys: pytest.CaptureFixture[str]) -> None:
    assert told(capsys, worst=0.15, projection=0.001) == ""
    assert told(capsys, worst=0.002, projection=0.0005) == ""
