"""The demo's problem on the creature, its poses, and their picture."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..generators import CREATURE_REGIONS, creature_paint
from ..material import DEFAULT_MATERIAL
from ..mesh import solid_of
from ..pictures import render_row
from ..reduction import PosingModel
from .motions import Motion, as_parameters

# Translations are up to a tenth of the animal's length.
PROBLEM: dict[str, Any] = {
    "mesh": "creature.msh",
    "material": {"model": DEFAULT_MATERIAL.kind, "lam": 1.0, "mu": 1.0},
    "stiffness": 2000,
    "domain": {"translation": 0.3, "angle_degrees": 45},
    "handles": [{"name": name, **region} for name, region in CREATURE_REGIONS.items()],
}

# The head looks towards +x and the back towards +z.
POSES: dict[str, dict[str, Motion]] = {
    "rest": {},
    "look up": {"head": Motion((0, -35, 0), (-0.05, 0, 0.05))},
    "look round": {"head": Motion((0, 0, -45), (0, -0.1, 0))},
    "tilt": {"head": Motion((35, 0, 0), (0, 0, 0.05))},
    "reach": {"head": Motion((0, -8, 0), (0.3, 0, 0.1))},
    "sniff": {"head": Motion((0, 28, 0), (0.22, 0, -0.22))},
    "wag": {"tail": Motion((-35, 0, 20), (0, -0.3, 0)), "head": Motion((0, -10, -25))},
    "play": {
        "head": Motion((-20, -15, -30), (0.05, -0.15, 0.1)),
        "tail": Motion((20, 0, -40), (0, -0.2, 0.15)),
    },
}
POSE_OF_OBJ = "look round"


def posed_shapes(model: PosingModel) -> dict[str, NDArray[np.float64]]:
    """The vertices (n, 3) of every pose of POSES, each solved from rest."""
    session = model.session()
    shapes = {}
    for name, motions in POSES.items():
        session.reset()
        parameters, _ = as_parameters(model.problem, motions)
        session.pose(parameters)
        shapes[name] = session.vertices
    return shapes


def contact_sheet(model: PosingModel, shapes: dict[str, NDArray[np.float64]]) -> NDArray[np.uint8]:
    """The poses in two rows with their names."""
    mesh = solid_of(model.problem.mesh, who="demo")
    return render_row(
        list(shapes.values()),
        mesh.surface,
        labels=list(shapes),
        colors=creature_paint(mesh),
        size=(420, 420),
        azimuth=-42.0,
        elevation=12.0,
    )
