"""Progress in a log, and the units of the summary."""

from __future__ import annotations

import pytest

from snapspace import SolveProgress
from snapspace.cli.progress import sample_progress, step_progress
from snapspace.cli.units import in_bytes, in_percent, in_time, two_digits


def test_a_log_has_one_line_for_every_tenth(capsys: pytest.CaptureFixture[str]) -> None:
    with step_progress("snapshots", total=40) as progress:
        for done in range(41):
            progress(done, 40)
            progress(done, 40)
    lines = capsys.readouterr().err.splitlines()
    assert len(lines) == 10
    assert lines[0].startswith("snapspace: snapshots: 4 of 40 samples, ")
    assert lines[0].endswith(" left")
    assert lines[-1].startswith("snapspace: snapshots: 40 of 40 samples, ")
    assert "left" not in lines[-1]


def test_samples_that_were_finished_before_are_not_progress(
    capsys: pytest.CaptureFixture[str],
) -> None:
    with sample_progress("snapshots", done=35, total=40) as progress:
        progress(SolveProgress(35, 40, 0.0, 0))
        progress(SolveProgress(36, 40, 1.0, 1))
    assert [line.split(",")[0] for line in capsys.readouterr().err.splitlines()] == [
        "snapspace: snapshots: 36 of 40 samples"
    ]


def test_the_error_of_held_out_samples_is_shown(capsys: pytest.CaptureFixture[str]) -> None:
    with sample_progress("snapshots", total=40, training=True) as progress:
        progress(SolveProgress(16, 40, 1.0, 16))
        progress(SolveProgress(32, 40, 2.0, 32, held_out_error=0.01234))
    before, after = capsys.readouterr().err.splitlines()
    assert "unseen" not in before
    assert after.startswith("snapspace: snapshots: 32 of 40 samples, ")
    assert after.endswith(" left, unseen samples within 1.2 %")


def test_solutions_that_judge_a_model_have_no_such_error(
    capsys: pytest.CaptureFixture[str],
) -> None:
    """It would be that of a model of these few solutions, not of the model that is validated."""
    with sample_progress("full solutions", total=4) as progress:
        progress(SolveProgress(4, 4, 1.0, 4, held_out_error=0.19))
    assert "unseen" not in capsys.readouterr().err


def test_steps_have_a_unit(capsys: pytest.CaptureFixture[str]) -> None:
    with step_progress("fits", total=2, unit="poses") as progress:
        progress(1, 2)
    assert capsys.readouterr().err.startswith("snapspace: fits: 1 of 2 poses, ")


@pytest.mark.parametrize(
    ("seconds", "text"),
    [
        (0.1234, "0.12 s"),
        (9.94, "9.9 s"),
        (45.4, "45 s"),
        (59.6, "1 min 00 s"),
        (7500, "2 h 05 min"),
    ],
)
def test_times(seconds: float, text: str) -> None:
    assert in_time(seconds) == text


@pytest.mark.parametrize(
    ("count", "text"),
    [
        (17, "17 bytes"),
        (1500, "1.5 kB"),
        (60_000_000, "60 MB"),
        (4.3e12, "4.3e+03 GB"),
        (None, "unknown"),
    ],
)
def test_sizes(count: int | None, text: str) -> None:
    assert in_bytes(count) == text


@pytest.mark.parametrize(
    ("share", "text"),
    [(0.00321, "0.32 %"), (0.22, "22 %"), (0.999, "100 %"), (1.361, "140 %"), (12.3, "1200 %")],
)
def test_shares(share: float, text: str) -> None:
    assert in_percent(share) == text


def test_two_digits_have_no_exponent() -> None:
    assert [two_digits(value) for value in (587.0, 9.04, 100_000.0)] == ["590", "9", "100000"]
