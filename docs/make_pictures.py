"""Makes the pictures of the docs, from the generated creature.

python docs/make_pictures.py
"""

from __future__ import annotations

import json
import tempfile
from pathlib import Path

import snapspace as ss
from snapspace import generators
from snapspace.cli.demo_creature import PROBLEM, contact_sheet, posed_shapes
from snapspace.pictures import save_png

FOLDER = Path(__file__).parent / "pictures"


def creature_problem(tets: int) -> ss.PosingProblem:
    """The demo's problem on a creature of a given size."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "creature.json"
        path.write_text(json.dumps(PROBLEM), encoding="utf-8")
        return ss.read_problem(path, mesh=generators.creature(tets))


def main() -> None:
    problem = creature_problem(60_000)
    snapshots = ss.solve_snapshots(problem, ss.sample(problem.domain, 300, seed=0))
    subspace = ss.snapshot_pca(snapshots, dimension=50)
    model = ss.reduce(problem, subspace, snapshots=snapshots)
    save_png(FOLDER / "creature.png", contact_sheet(model, posed_shapes(model)))


if __name__ == "__main__":
    main()
