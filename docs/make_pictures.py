"""Makes the pictures of the docs, from the generated creature.

python docs/make_pictures.py
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

import snapspace as ss
from snapspace import generators
from snapspace.cli.demo_creature import PROBLEM, contact_sheet, posed_shapes
from snapspace.pictures import save_png
from snapspace.problem import Handles, in_box, in_sphere

FOLDER = Path(__file__).parent / "pictures"


def creature_problem(tets: int) -> ss.PosingProblem:
    """The demo's problem on a creature of a given size."""
    mesh = generators.creature(tets)
    masks = []
    for entry in PROBLEM["handles"]:
        mask = np.zeros(len(mesh.vertices), dtype=bool)
        for lower, upper in entry.get("boxes", []):
            mask |= in_box(mesh.vertices, lower, upper)
        for center, radius in entry.get("spheres", []):
            mask |= in_sphere(mesh.vertices, center, radius)
        masks.append(mask)
    handles = Handles(masks, names=[entry["name"] for entry in PROBLEM["handles"]])
    domain = ss.HandleBox(
        translation=PROBLEM["domain"]["translation"],
        angle=float(np.deg2rad(PROBLEM["domain"]["angle_degrees"])),
    )
    return ss.PosingProblem(mesh, handles, domain=domain, stiffness=PROBLEM["stiffness"])


def main() -> None:
    problem = creature_problem(60_000)
    snapshots = ss.solve_snapshots(problem, ss.sample(problem.domain, 300, seed=0))
    subspace = ss.snapshot_pca(snapshots, dimension=50)
    model = ss.reduce(problem, subspace, snapshots=snapshots)
    save_png(FOLDER / "creature.png", contact_sheet(model, posed_shapes(model)))


if __name__ == "__main__":
    main()
