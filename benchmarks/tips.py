"""Posing problems that nobody tuned to: random handles at the tips of the folder's tet meshes."""

from __future__ import annotations

import sys

import common
import numpy as np

import snapspace as ss

FILES = (
    "spot_Yq1.4.mesh",
    "hand.mesh",
    "tosca_centaur_Yq2.mesh",
    "tosca_dog_Yq2.mesh",
    "sumner_lion_Yq1.4a.mesh",
    "Armadillo13K.msh",
    "octopus-low.mesh",
    "dragon_Yq1.83.mesh",
    "elephant_Yq2.mesh",
)
#: A handle's centre is drawn from this share of the vertices, those farthest from the others.
TIPS = 0.05


def tips(seed: int) -> ss.PosingProblem:
    """Two or three balls of vertices, far from each other; all but the first move.

    Mesh, places, radius (4 to 9 % of the diagonal) and motions (8 to 20 % of it, 25 to 50 degrees)
    follow from the seed.
    """
    path = common.meshes_folder() / "tets" / FILES[seed % len(FILES)]
    if not path.is_file():
        sys.exit(f"{path} is missing: set SNAPSPACE_MESHES")
    mesh, rng = ss.read_tets(path), np.random.default_rng(seed)
    count = int(rng.integers(2, 4))
    centers = [int(rng.integers(len(mesh.vertices)))]
    for _ in range(count):
        nearest = np.min([_distances(mesh, center) for center in centers], axis=0)
        farthest = np.argsort(nearest)[-int(TIPS * len(nearest)) :]
        centers.append(int(rng.choice(farthest)))
    radius = rng.uniform(0.04, 0.09) * mesh.diagonal
    balls = [_distances(mesh, center) < radius for center in centers[1:]]
    domain = ss.HandleBox(
        translation=rng.uniform(0.08, 0.2) * mesh.diagonal, angle=np.deg2rad(rng.uniform(25, 50))
    )
    return ss.PosingProblem(mesh, ss.Handles(balls), domain=domain)


def _distances(mesh: ss.TetMesh, vertex: int) -> np.ndarray:
    distances: np.ndarray = np.linalg.norm(mesh.vertices - mesh.vertices[vertex], axis=1)
    return distances
