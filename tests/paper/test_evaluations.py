"""The program of evaluations: costs, orderings and charts."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import snapspace as ss
from paper.evaluation import (
    Evaluation,
    drag,
    local_global_steps,
    microseconds,
    value_and_gradient,
    warm_frames,
)
from paper.evaluation_charts import draw
from paper.evaluation_orderings import faults
from paper.evaluators import clustered_energy
from paper.rivals import skinning_subspace

from ..shapes import bar_problem, interpolation_problem


def rows(**changed: float) -> list[dict[str, Any]]:
    """A table in order, with the medians of some rows replaced."""
    listed = [
        ("exact", "exact quartic", 10626, 10626, 1e-9),
        ("few", "cubature", 20, 7200, 0.05),
        ("many", "cubature", 160, 57600, 0.001),
        ("small", "coarse mesh", 250, 7500, 0.2),
        ("large", "coarse mesh", 4000, 120000, 0.02),
        ("some", "rotation clusters", 10, 3600, 0.06),
        ("more", "rotation clusters", 300, 108000, 0.01),
    ]
    return [
        {
            "shape": "bar, bent",
            "material": "stvk",
            "d": 20,
            "evaluation": name,
            "elements": elements,
            "multiply-adds": adds,
            "median": changed.get(key, median),
            "us": adds / 1e4,
        }
        for key, name, elements, adds, median in listed
    ]


def test_evaluations_in_order_pass() -> None:
    assert faults(rows()) == []


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"exact": 0.01}, "the exact quartic adds an error of 0.01"),
        ({"few": 0.0005}, "cubature does not gain from 160 elements"),
        ({"some": 0.005}, "rotation clusters does not gain from 300 elements"),
        ({"more": 0.0005}, "300 clusters are better than cubatures"),
        ({"small": 0.04}, "a coarse mesh of 250 tets is better than cubatures"),
        ({"large": 0.0005}, "a coarse mesh of 4000 tets is better than cubatures"),
    ],
)
def test_evaluations_in_another_order_are_reported(changed: dict[str, float], message: str) -> None:
    assert faults(rows(**changed)) == [f"bar, bent, stvk, d = 20: {message}"]


def test_the_fastest_form_counts() -> None:
    model = ss.reduce(bar_problem(), skinning_subspace(bar_problem(), 12), energy="exact")
    calls = {"fast": 0, "slow": 0}

    def fast(q: np.ndarray) -> None:
        calls["fast"] += 1

    def slow(q: np.ndarray) -> float:
        calls["slow"] += 1
        return float(np.linalg.norm(np.ones(20_000)))

    both = Evaluation("two forms", 1, 1, model, (slow, fast))
    only = Evaluation("one form", 1, 1, model, (slow,))
    assert microseconds(both, np.zeros(12)) < microseconds(only, np.zeros(12))
    assert min(calls.values()) > 1


def test_a_drag_is_solved_frame_by_frame() -> None:
    model = ss.reduce(bar_problem(), skinning_subspace(bar_problem(), 12), energy="exact")
    milliseconds, evaluations = warm_frames(model, frames=4)
    assert milliseconds > 0 and evaluations >= 1


def test_blends_are_evaluated_with_given_weights() -> None:
    problem = interpolation_problem()
    solved = ss.solve_snapshots(problem, ss.sample(problem.domain, 8), threads=1)
    subspace = ss.snapshot_pca(solved, dimension=4)
    weights, q = np.array([0.2, 0.5, 0.3]), np.array([0.1, 0.2, -0.1, 0.05])
    for energy in ("full", "exact", "cubature"):
        model = ss.reduce(problem, subspace, energy=energy, snapshots=solved)
        value, _ = value_and_gradient(model, weights)(q)
        assert value == pytest.approx(model.value(q, weights), rel=1e-6)


def test_each_shape_has_a_picture(tmp_path: Path) -> None:
    draw(rows(), tmp_path)
    picture = tmp_path / "evaluations_bar_bent.png"
    assert 1_000 < picture.stat().st_size < 150_000


def test_a_drag_joins_parameters_by_straight_lines() -> None:
    path = drag(bar_problem().domain, 45)
    assert path.shape == (46, 12)
    assert np.allclose(np.diff(path[:31], axis=0), path[1] - path[0])
    assert not np.allclose(path[31] - path[30], path[1] - path[0]), "a corner"


def test_slow_drags_need_few_local_and_global_steps() -> None:
    plain = bar_problem()
    problem = ss.PosingProblem(
        plain.mesh, plain.handles, domain=plain.domain, material=ss.ARAP(), stiffness=100.0
    )
    subspace = skinning_subspace(problem, 12)
    model = ss.reduce(problem, subspace, energy="full")
    labels = np.arange(len(problem.mesh.tets)) % 5
    energy = clustered_energy(problem, subspace, labels)
    assert 1 <= local_global_steps(model, energy, frames=3) < 50
