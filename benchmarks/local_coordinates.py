"""Local coordinates of cubatures: what an evaluation reads, how long it takes, and its error.

    python benchmarks/local_coordinates.py                   # all problems and generated poses
    python benchmarks/local_coordinates.py --problem armadillo --set lizard-20

Default models, with and without local coordinates, in turn in one process: microseconds of an
evaluation, milliseconds of a jump, and errors on 30 unseen samples against tight full solutions.
"Moved" is the distance between both solutions. Models whose rows are small have no local
coordinates and are left out.
"""

from __future__ import annotations

import argparse
import json
import time
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import blend_paths
import common
import numpy as np
import problems

import snapspace as ss
from snapspace.cubature import BlendedCubature, LocalRows
from snapspace.validation import solution_errors, solved_reference

#: Evaluations of each energy, in turns.
TURNS, EVALUATIONS = 7, 60


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--problem", nargs="*", default=list(problems.NAMES))
    parser.add_argument("--set", nargs="*", default=list(blend_paths.GENERATED))
    parser.add_argument("--validate", type=int, default=30, help="number of unseen samples")
    parser.add_argument("--json", action="store_true")
    args = parser.parse_args()
    rows = []
    for name, problem in chosen(args):
        row = compared(name, problem, args.validate)
        if row is None:
            continue
        rows.append(row)
        if args.json:
            print(json.dumps(row), flush=True)
    if not args.json and rows:
        common.print_rows(rows, title="local coordinates", width=200)


def chosen(args: argparse.Namespace) -> Iterator[tuple[str, Any]]:
    """Names and problems."""
    for name in args.problem:
        yield name, common.with_material(problems.read(name), "stable-neo-hookean")
    for name in args.set:
        poses = blend_paths.read(name, shell=False)
        yield name, ss.InterpolationProblem(poses, material=ss.StableNeoHookean())


def compared(name: str, problem: Any, count: int) -> dict[str, Any] | None:
    """A row of the table; None if the default model has no local coordinates."""
    local = ss.accurate_model(problem).model
    energy = energy_of(local)
    if not isinstance(energy.stored_rows, LocalRows):
        return None
    dense = without(local)
    reference = solved_reference(problem, samples=count)
    models = {"without": dense, "with": local}
    micros = dict(zip(models, evaluation_micros(list(models.values())), strict=True))
    ends, jumps = zip(*(jumped(model, reference) for model in models.values()), strict=True)
    errors = {
        key: solution_errors(model, reference, end)
        for (key, model), end in zip(models.items(), ends, strict=True)
    }
    sizes = energy.stored_rows.sizes
    apart = np.linalg.norm(ends[1] - ends[0], axis=1) / np.linalg.norm(ends[0], axis=1)
    return {
        "problem": name,
        "d": local.dimension,
        "tets": len(energy.tets),
        "clusters": len(sizes),
        "mean rank": float(sizes[:, 1].mean()),
        "numbers": energy.stored_rows.numbers / energy.rows.size,
        "us, without": round(micros["without"]),
        "with": round(micros["with"]),
        "jump ms, without": jumps[0],
        "with ": jumps[1],
        "median, mean, without": spread(errors["without"]),
        " with": spread(errors["with"]),
        "moved": spread(apart),
    }


def spread(errors: np.ndarray) -> str:
    return f"{np.median(errors):.4f} / {np.mean(errors):.4f}"


def energy_of(model: Any) -> Any:
    """The cubature of a model."""
    return model.blends if isinstance(model, ss.InterpolationModel) else model.elastic


def without(model: Any) -> Any:
    """The model with rows of all coordinates."""
    energy = energy_of(model)
    arguments = model.problem, model.subspace, energy.tets, energy.weights
    if isinstance(model, ss.InterpolationModel):
        return replace(model, blends=BlendedCubature.of_tets(*arguments))
    return replace(model, elastic=ss.Cubature.of_tets(*arguments))


def evaluation_micros(models: list[Any]) -> list[float]:
    """Microseconds of an evaluation of each model's objective, the least of several turns."""
    calls = []
    for model in models:
        session = model.session()
        session.set_parameters(model.training_parameters[-1])
        calls.append(session._loop.value_and_gradient)
    q = models[0].training_coordinates[-1]
    times: list[list[float]] = [[] for _ in models]
    for _ in range(TURNS):
        for call, own in zip(calls, times, strict=True):
            begin = time.perf_counter()
            for _ in range(EVALUATIONS):
                call(q)
            own.append((time.perf_counter() - begin) / EVALUATIONS)
    return [1e6 * min(own) for own in times]


def jumped(model: Any, reference: ss.Snapshots) -> tuple[np.ndarray, float]:
    """Coordinates (k, d) of solves from rest or the mean shape, and their median ms."""
    session, ends, millis = model.session(), [], []
    for w in reference.parameters:
        session.reset()
        millis.append(1e3 * session.set_parameters(w).seconds)
        ends.append(session.q.copy())
    return np.array(ends), float(np.median(millis))


if __name__ == "__main__":
    main()
