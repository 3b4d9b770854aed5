"""Whether solutions are unique: part `uniqueness` of materials.py."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from itertools import combinations
from typing import Any

import common
import numpy as np
import problems

import snapspace as ss
from snapspace import _core as core
from snapspace.mesh import mass_norms
from snapspace.validation import unseen_parameters

TOLERANCE, MOST_ITERATIONS = 1e-10, 5000
#: Number of samples from which a pose takes its nearest neighbour.
NEIGHBOURS = 48
#: Distance that noise moves every vertex, in mean edge lengths. Strong noise has this standard
#: deviation in every coordinate, which moves a vertex by 0.48 edge lengths on average and up to
#: about 1.3.
NOISE = 0.3
STRONG = "strong noise"


def uniqueness(name: str, args: argparse.Namespace) -> Iterator[dict[str, Any]]:
    """Distances between tight solutions from different starts, and their inverted tets.

    Distances are relative to the displacement, in the mass norm. "distance" is the largest between
    two solutions of a pose, without strong noise; the others are distances to the solution from
    rest.
    """
    for kind in args.material:
        body = common.with_material(problems.read(name), kind)
        parameters = unseen_parameters(body.domain, args.validate or 8, seed=args.seed + 1)
        starts = _starts(body, parameters, args.seed)
        found, inverted, converged = {}, [], 0
        for start, shapes in starts.items():
            batch = body.system.solve_fast(
                body.inputs(parameters),
                shapes,
                tolerance=TOLERANCE,
                max_iterations=MOST_ITERATIONS,
                threads=0,
                control=core.SolveControl(),
                modes=body.solving.soft_modes(),
            )
            found[start] = batch.shapes
            inverted += [report.inverted_tets for report in batch.reports]
            converged += sum(report.status.name == "converged" for report in batch.reports)
        mass, size = body.mass(), mass_norms(body.mass(), found["rest"])
        pairs = combinations((shapes for start, shapes in found.items() if start != STRONG), 2)
        far = np.max([mass_norms(mass, a - b) / size for a, b in pairs], axis=0)
        row: dict[str, Any] = {
            "problem": name,
            "material": kind,
            "distance, median": float(np.median(far)),
            "max": float(far.max()),
        }
        for start in list(starts)[1:]:
            apart = mass_norms(mass, found[start] - found["rest"]) / size
            row[f"{start}, max"] = float(apart.max())
        row["inverted tets, median"] = float(np.median(inverted))
        row["inverted, max"] = int(np.max(inverted))
        row["converged"] = f"{converged} of {len(parameters) * len(starts)}"
        yield row


def _starts(body: ss.PosingProblem, parameters: np.ndarray, seed: int) -> dict[str, np.ndarray]:
    """Starting displacements (k, 3n) by name; "rest" is the first."""
    rest = np.zeros((len(parameters), body.base.size))
    samples = ss.sample(body.domain, NEIGHBOURS, method="sobol", seed=seed)
    solved = common.solved(body, samples, tolerance=1e-5)
    distances = np.linalg.norm(
        body.domain.scaled(parameters)[:, None] - body.domain.scaled(samples), axis=2
    )
    neighbours = [solved.displacements[int(k)] for k in distances.argmin(axis=1)]
    tets, vertices = body.mesh.tets, body.mesh.vertices
    pairs = [vertices[tets[:, i]] - vertices[tets[:, j]] for i, j in combinations(range(4), 2)]
    edge = float(np.mean(np.linalg.norm(pairs, axis=2)))
    noise = np.random.default_rng(seed).standard_normal((*rest.shape[:1], len(vertices), 3))
    directions = noise / np.linalg.norm(noise, axis=2, keepdims=True)
    return {
        "rest": rest,
        "guess": body.guesses(parameters),
        "neighbour": np.array(neighbours),
        "noise": NOISE * edge * directions.reshape(rest.shape),
        STRONG: NOISE * edge * noise.reshape(rest.shape),
    }
