"""The picture of posing: the generated creature, its head and tail moved live."""

from __future__ import annotations

import json
import tempfile
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

import snapspace as ss
from snapspace import generators
from snapspace.cli.demo_creature import PROBLEM, contact_sheet, posed_shapes


def creature_picture() -> NDArray[np.uint8]:
    """The demo's contact sheet, from a finer mesh and a larger model."""
    problem = creature_problem(60_000)
    snapshots = ss.solve_snapshots(problem, ss.sample(problem.domain, 300, seed=0))
    subspace = ss.snapshot_pca(snapshots, dimension=50)
    model = ss.reduce(problem, subspace, snapshots=snapshots)
    return contact_sheet(model, posed_shapes(model))


def creature_problem(tets: int) -> ss.PosingProblem:
    """The demo's problem on a creature of a given size."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "creature.json"
        path.write_text(json.dumps(PROBLEM), encoding="utf-8")
        return ss.read_problem(path, mesh=generators.creature(tets))
