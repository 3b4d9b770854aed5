"""Figure 9: leave-one-out errors on blends of the Centaur, against the number of samples.

As in the paper: a sample is approximated by its projection onto the subspace of all others, the
error is relative to its distance from the mean shape, and mean and deviation are those over all
samples. Methods put their samples in different places, and are also compared by `uniform`, the mean
error of the same random samples, each left out where it is one of the subspace's own.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

import snapspace as ss
from snapspace.pictures import Curve, chart, save_png

from .cached import cached_snapshots
from .cases import MATERIALS, Case, read
from .figure9_orderings import errors_by_samples_in_order
from .leave_one_out import errors_of_others, leave_one_out_errors
from .orderings import Rows
from .result import Result

#: Dimensions of the subspaces; the paper's largest for the Centaur is 24.
DIMENSIONS = (6, 12, 18, 24)
#: The dimension that the paper finds sufficient, at which methods are compared.
SUFFICIENT = 18
#: Numbers of samples, also one more than each dimension, so that the others just span it, and twice
#: each dimension.
COUNTS = (7, 9, 12, 13, 16, 19, 24, 25, 30, 36, 40, 48, 60)
#: The most samples of each material: those of St.Venant-Kirchhoff take long.
MOST = {"stvk": 40, "stable-neo-hookean": 60}
MOST_QUICK = 40
#: Samples of table 1, which are solved apart from the others so that they are shared.
SHARED = 40
#: Samples that the greedy method chooses together.
BATCH = 20
METHODS = ("random", "sobol", "grid", "greedy")


def run(*, quick: bool = False) -> Result:
    """Errors of all methods, for the paper's material and for stable neo-Hookean."""
    result = Result("figure9", "Figure 9: leave-one-out errors by the number of samples")
    for kind in MATERIALS:
        _add(result, read("centaur", kind, quick=quick), kind, MOST_QUICK if quick else MOST[kind])
    return result


def _add(result: Result, case: Case, kind: str, most: int) -> None:
    problem = case.problem
    assert isinstance(problem, ss.InterpolationProblem)
    gram = ss.SnapshotGram.of(problem)
    uniform: NDArray[np.intp] | None = None
    for method in METHODS:
        subsets = _subsets(gram, problem, method, [count for count in COUNTS if count <= most])
        if uniform is None:
            uniform = subsets[-1]
        for subset in subsets:
            dimensions = DIMENSIONS if method == "random" else (SUFFICIENT,)
            possible = [d for d in dimensions if d < len(subset)]
            if not possible:
                continue
            own = leave_one_out_errors(gram, subset, possible)
            others = errors_of_others(gram, subset, uniform, possible).mean(axis=1)
            for d, errors, other in zip(possible, own, others, strict=True):
                result.add(
                    shape=case.shape,
                    material=kind,
                    method=method,
                    samples=len(subset),
                    d=d,
                    mean=float(errors.mean()),
                    deviation=float(errors.std()),
                    uniform=float(other),
                )


def _subsets(
    gram: ss.SnapshotGram, problem: ss.InterpolationProblem, method: str, counts: list[int]
) -> list[NDArray[np.intp]]:
    """Rows of samples of a method, fewest first; they are solved and added to the products."""
    if method == "grid":  # each grid has other points
        sizes = {len(ss.sample(problem.domain, count, method="grid")) for count in counts}
        enough = sorted(size for size in sizes if size > SUFFICIENT)
        return [_grown(gram, _solved(problem, "grid", size)) for size in enough]
    rows = _grown(gram, _solved(problem, method, counts[-1]))
    return [rows[:count] for count in counts]


def _solved(problem: ss.InterpolationProblem, method: str, count: int) -> ss.Snapshots:
    """Converged samples of a method; those that table 1 solves are shared with it."""
    if method == "greedy":
        found = ss.greedy_snapshots(problem, count, batch=BATCH)
        return found.select(found.converged)
    parameters = ss.sample(problem.domain, count, method=method)  # type: ignore[arg-type]
    found = cached_snapshots(problem, parameters[:SHARED])
    if count > SHARED:
        found = found.joined(cached_snapshots(problem, parameters[SHARED:]))
    return found.select(found.converged)


def _grown(gram: ss.SnapshotGram, snapshots: ss.Snapshots) -> NDArray[np.intp]:
    """Adds samples to the products, and returns their rows."""
    first = len(gram)
    gram.add(list(snapshots.displacements))
    return np.arange(first, len(gram))


faults = errors_by_samples_in_order


def draw(rows: Rows, folder: Path) -> None:
    """Two pictures of each material: random samples with all dimensions, and all methods."""
    for kind in MATERIALS:
        some = [row for row in rows if row["material"] == kind]
        if some:
            save_png(folder / f"figure9_dimensions_{kind}.png", _by_dimension(some))
            save_png(folder / f"figure9_methods_{kind}.png", _by_method(some))


def _by_dimension(rows: Rows) -> NDArray[np.uint8]:
    random = [row for row in rows if row["method"] == "random"]
    curves = [
        _curve(f"d = {d}", [row for row in random if row["d"] == d], "mean")
        for d in sorted({row["d"] for row in random})
    ]
    return chart(
        curves,
        title=f"{rows[0]['shape']}, {rows[0]['material']}, random samples",
        x_name="samples",
        y_name="leave-one-out error, mean",
    )


def _by_method(rows: Rows) -> NDArray[np.uint8]:
    chosen = [row for row in rows if row["d"] == SUFFICIENT]
    curves = [
        _curve(method, [row for row in chosen if row["method"] == method], "uniform")
        for method in dict.fromkeys(row["method"] for row in chosen)
    ]
    return chart(
        curves,
        title=f"{rows[0]['shape']}, {rows[0]['material']}, d = {SUFFICIENT}",
        x_name="samples",
        y_name="error on random samples, mean",
    )


def _curve(name: str, rows: Rows, column: str) -> Curve:
    return Curve(name, [row["samples"] for row in rows], [row[column] for row in rows])
