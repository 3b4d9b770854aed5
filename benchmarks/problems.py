"""Posing problems by name: those of the meshes' folder, and generated ones that need no files.

Protocols and defaults are chosen on one half of them and judged on the other. The problems that
earlier tuning used, the Dragon, the Elephant and the creature, belong to the first half.
"""

from __future__ import annotations

import sys
from collections.abc import Callable

import common
import numpy as np
from tips import tips

import snapspace as ss
from snapspace import generators
from snapspace.generators.implicit_shapes import bent_cone, smooth_union, sphere

#: Names of the meshes' folder.
SHARED = ("dragon", "elephant", "spot", "armadillo", "dog_head", "hand_five_fingers")
#: Stiffness of handles times the squared diagonal, so that results do not depend on the unit.
STIFFNESS = 2e5


def read(name: str) -> ss.PosingProblem:
    """A problem by one of the names of NAMES, `creature:TETS` of another size, or `tips:SEED`."""
    if name.startswith("tips:"):
        return tips(int(name.partition(":")[2]))
    if name.startswith("creature:"):
        return common.creature_problem(int(name.partition(":")[2]))
    if name in GENERATED:
        return GENERATED[name]()
    if name not in SHARED:
        sys.exit(f"unknown problem '{name}'; known are {', '.join(NAMES)}")
    return common.read_problem(name)


def creature() -> ss.PosingProblem:
    """The creature's head moves: 6 parameters."""
    return _creature("feet", "head")


def creature_with_tail() -> ss.PosingProblem:
    """The creature's head and tail move: 12 parameters."""
    return _creature("feet", "head", "tail")


def _creature(*names: str) -> ss.PosingProblem:
    mesh = generators.creature(20_000)
    parts = generators.creature_handles(mesh)
    handles = ss.Handles([parts[name] for name in names], names=list(names))
    return _problem(mesh, handles, ss.HandleBox(translation=0.3, angle=np.pi / 4))


def bar() -> ss.PosingProblem:
    """A long bar between two ends: 6 parameters, up to a right angle of twist."""
    mesh = generators.bar(64, 8, 8, length=8.0)
    x = mesh.vertices[:, 0]
    handles = ss.Handles(
        [np.flatnonzero(x < 0.6), np.flatnonzero(x > 7.4)], names=["left", "right"]
    )
    angle = (np.pi / 2, np.pi / 4, np.pi / 4)
    return _problem(mesh, handles, ss.HandleBox(translation=1.0, angle=angle))


def bridge() -> ss.PosingProblem:
    """A flat bar held at both ends, with a moving middle: 6 parameters."""
    mesh = generators.bar(48, 10, 4, length=6.0, width=1.2, height=0.5)
    x = mesh.vertices[:, 0]
    handles = ss.Handles(
        [np.flatnonzero((x < 0.3) | (x > 5.7)), np.flatnonzero(abs(x - 3.0) < 0.2)],
        names=["ends", "middle"],
    )
    return _problem(mesh, handles, ss.HandleBox(translation=0.8, angle=np.pi / 4))


def helix() -> ss.PosingProblem:
    """A rod wound into a helix, moved at one end: 6 parameters."""
    radial, along = 3, 120
    mesh = generators.helix(radial, along)
    disc = len(mesh.vertices) // (along + 1)
    ends = [np.arange(4 * disc), np.arange(len(mesh.vertices) - 4 * disc, len(mesh.vertices))]
    handles = ss.Handles(ends, names=["lower", "upper"])
    return _problem(mesh, handles, ss.HandleBox(translation=0.8, angle=np.pi / 4))


def tripod() -> ss.PosingProblem:
    """A ball with three bent arms: one is held, two move; 12 parameters."""
    turns = [2 * np.pi / 3 * k for k in range(3)]
    tips = np.array([[1.5 * np.cos(a), 1.5 * np.sin(a), -0.5] for a in turns])

    def shape(points: np.ndarray) -> np.ndarray:
        value = sphere(points, (0.0, 0.0, 0.0), 0.45)
        for tip in tips:
            arm = [(0.0, 0.0, 0.0, 0.3), (*(0.6 * tip[:2]), 0.5, 0.22), (*tip, 0.17)]
            value = smooth_union(value, bent_cone(points, arm), 0.15)
        return value

    mesh = generators.stuff(shape, (-1.9, -1.9, -1.1), (1.9, 1.9, 0.9), 0.075)
    near = [np.flatnonzero(np.linalg.norm(mesh.vertices - tip, axis=1) < 0.3) for tip in tips]
    handles = ss.Handles(near, names=["held", "left", "right"])
    return _problem(mesh, handles, ss.HandleBox(translation=0.3, angle=np.pi / 4))


def _problem(mesh: ss.TetMesh, handles: ss.Handles, domain: ss.HandleBox) -> ss.PosingProblem:
    stiffness = STIFFNESS / mesh.diagonal**2
    return ss.PosingProblem(mesh, handles, domain=domain, stiffness=stiffness)


#: Generated problems by name.
GENERATED: dict[str, Callable[[], ss.PosingProblem]] = {
    "creature": creature,
    "creature_with_tail": creature_with_tail,
    "bar": bar,
    "bridge": bridge,
    "helix": helix,
    "tripod": tripod,
}
NAMES = (*SHARED, *GENERATED)
#: Help text of --problem.
HELP = f"any of {', '.join(NAMES)}, creature:TETS, or tips:SEED with random handles"
#: Defaults are chosen on these, and judged on the others.
CHOOSING = ("dragon", "elephant", "armadillo", "creature", "creature_with_tail")
JUDGING = ("spot", "dog_head", "hand_five_fingers", "bar", "bridge", "helix", "tripod")
