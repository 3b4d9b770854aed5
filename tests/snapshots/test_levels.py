"""Every build of the core gives the same numbers up to rounding."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from typing import Any

import numpy as np
import pytest

from snapspace import _core

SOLVE = """
import json
import snapspace as ss
from snapspace import _core
from snapspace.generators import bar

mesh = bar(8, 2, 2)
x = mesh.vertices[:, 0]
problem = ss.PosingProblem(
    mesh,
    ss.Handles([x < 0.6, x > 3.4]),
    domain=ss.HandleBox(translation=0.25, angle=0.25),
    material=ss.StVK(),
)
samples = ss.sample(problem.domain, 6, seed=3)
result = {"level": _core.level}
for solver in ("fast", "newton"):
    options = ss.SolverOptions(solver=solver, tolerance=1e-13)
    solved = ss.solve_snapshots(problem, samples, options=options, threads=1)
    result[solver] = {
        "converged": bool(solved.converged.all()),
        "shapes": solved.shapes.tolist(),
        "values": [report.value for report in solved.reports],
    }
model = ss.reduce(problem, ss.snapshot_pca(solved, dimension=4), threads=1)
session = model.session()
session.pose(samples[0])
result["coefficients"] = model.elastic.coefficients.tolist()
result["posed"] = session.vertices.tolist()
print(json.dumps(result))
"""


def run(code: str, level: str | None) -> subprocess.CompletedProcess[str]:
    environment = {k: v for k, v in os.environ.items() if k != "SNAPSPACE_LEVEL"}
    if level is not None:
        environment["SNAPSPACE_LEVEL"] = level
    return subprocess.run(
        [sys.executable, "-c", code], env=environment, capture_output=True, text=True, timeout=120
    )


def solve(level: str) -> Any:
    finished = run(SOLVE, level)
    assert finished.returncode == 0, finished.stderr
    return json.loads(finished.stdout)


def test_levels_agree() -> None:
    """Shapes agree to 1e-6 of the displacement; F agrees to rounding at tolerance 1e-13.

    Sums have another order and fused multiply-adds round once less, so bits differ. Along a path of
    forty iterations these differences grow to 1e-6.
    """
    levels = _core.available_levels()
    assert _core.level in levels
    if len(levels) == 1:
        pytest.skip("`make setup` builds one level only; .ci/run runs this on a wheel")
    results = {level: solve(level) for level in levels}
    reference = results["baseline"]
    for level, result in results.items():
        assert result["level"] == level
        for solver in ("fast", "newton"):
            assert result[solver]["converged"]
            np.testing.assert_allclose(
                result[solver]["values"], reference[solver]["values"], rtol=1e-11
            )
            np.testing.assert_allclose(
                result[solver]["shapes"], reference[solver]["shapes"], rtol=0, atol=2.5e-7
            )
        np.testing.assert_allclose(result["posed"], reference["posed"], rtol=0, atol=2.5e-7)
        scale = np.abs(reference["coefficients"]).max()
        np.testing.assert_allclose(
            result["coefficients"], reference["coefficients"], rtol=0, atol=1e-6 * scale
        )


def test_an_unknown_level_is_refused_with_the_known_ones() -> None:
    finished = run("from snapspace import ElasticEnergy", "avx")
    assert finished.returncode != 0
    assert finished.stderr.splitlines()[-1] == (
        "ImportError: SNAPSPACE_LEVEL=avx: known levels are v4, v3, baseline"
    )


def install_all_builds(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("importlib.util.find_spec", lambda name: name)


def test_a_level_beyond_the_processor_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    install_all_builds(monkeypatch)
    monkeypatch.setattr(_core, "cpu_level", lambda: 1)
    monkeypatch.setenv("SNAPSPACE_LEVEL", "v4")
    with pytest.raises(
        ImportError, match=r"SNAPSPACE_LEVEL=v4: available here are baseline \(.*\); unset it"
    ):
        _core._chosen_level()  # type: ignore[attr-defined]


@pytest.mark.parametrize(
    ("processor", "levels"),
    [
        (4, ["v4", "v3", "baseline"]),
        (3, ["v3", "baseline"]),
        (2, ["baseline"]),
        (0, ["baseline"]),
    ],
)
def test_the_widest_level_is_chosen(
    monkeypatch: pytest.MonkeyPatch, processor: int, levels: list[str]
) -> None:
    monkeypatch.setattr(_core, "cpu_level", lambda: processor)
    install_all_builds(monkeypatch)
    monkeypatch.delenv("SNAPSPACE_LEVEL", raising=False)
    assert _core.available_levels() == levels
    assert _core._chosen_level() == levels[0]  # type: ignore[attr-defined]


def test_a_build_that_is_not_installed_is_not_chosen(monkeypatch: pytest.MonkeyPatch) -> None:
    """Universal macOS wheels and old compilers have only the plain build."""
    monkeypatch.setattr(_core, "cpu_level", lambda: 4)
    monkeypatch.setattr(
        "importlib.util.find_spec", lambda name: name if name.endswith("baseline") else None
    )
    assert _core.available_levels() == ["baseline"]


def test_a_build_of_a_better_processor_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    """`make setup` made the environment on one machine, and another machine uses it."""
    monkeypatch.setattr(_core, "cpu_level", lambda: 3)
    monkeypatch.setattr(
        "importlib.util.find_spec", lambda name: name if name.endswith("v4") else None
    )
    assert _core.available_levels() == []
    with pytest.raises(ImportError, match=r"none of the installed builds .* run `make setup` here"):
        _core._chosen_level()  # type: ignore[attr-defined]
