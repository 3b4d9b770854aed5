"""The picture of materials: one strong pose of a creature in each of them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

import snapspace as ss
from snapspace.generators import creature, creature_handles
from snapspace.material import MATERIALS, Material
from snapspace.pictures import render_row

TETS = 40_000
#: The head turns over and is pressed into the body: translation, then extrinsic Euler angles.
POSE = [-0.1, 0.0, -0.35, np.deg2rad(70), np.deg2rad(-20), np.deg2rad(-35)]
POISSON_RATIO = 0.4


def materials_picture() -> NDArray[np.uint8]:
    """Full solutions of one pose, a column for each material; all have the same small strains."""
    mesh = creature(TETS)
    parts = creature_handles(mesh)
    handles = ss.Handles([parts["feet"], parts["head"]], names=["feet", "head"])
    domain = ss.HandleBox(translation=0.5, angle=np.deg2rad(80))
    shapes, labels = [mesh.vertices], ["rest"]
    for kind in MATERIALS.values():
        material = kind.from_young(youngs_modulus=1.0, poisson_ratio=POISSON_RATIO)
        problem = ss.PosingProblem(mesh, handles, domain=domain, material=material)
        shapes.append(solution(problem))
        labels.append(label(material, problem, shapes[-1]))
    return render_row(
        shapes,
        mesh.surface,
        labels=labels,
        columns=3,
        size=(420, 380),
        azimuth=-42.0,
        elevation=12.0,
        font_size=19,
    )


def solution(problem: ss.PosingProblem) -> NDArray[np.float64]:
    """Vertices of the tight full solution, reached in ten steps from rest."""
    steps = np.linspace(0.1, 1.0, 10)[:, None] * np.array(POSE)
    options = ss.SolverOptions(tolerance=1e-8, block=1)
    solved = ss.solve_snapshots(problem, steps, options=options)
    shape: NDArray[np.float64] = solved.shapes[-1].reshape(-1, 3)
    return shape


def label(material: Material, problem: ss.PosingProblem, vertices: NDArray[np.float64]) -> str:
    """The material, and how many tets are inverted."""
    return f"{material.title}: {problem.energy.inverted_tets(vertices)} inverted"
