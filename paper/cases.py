"""Cases: the paper's problems by name, on real meshes or on generated stand-ins."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import snapspace as ss
from snapspace import generators
from snapspace.material import material_class

#: The paper's material, and the default of Snapspace.
MATERIALS = ("stvk", "stable-neo-hookean")
#: Volume of the Armadillo in the paper.
ARMADILLO_VOLUME = 234741.0


@dataclass(frozen=True)
class Case:
    """A problem, and the name of the shape that it is of.

    shape : of a real mesh, or "generated ..." for a stand-in
    """

    problem: ss.PosingProblem | ss.InterpolationProblem
    shape: str


def meshes_folder() -> Path | None:
    """The folder of real meshes, SNAPSPACE_MESHES or ../shared/meshes; None if there is none."""
    default = Path(__file__).parents[2] / "shared" / "meshes"
    folder = Path(os.environ.get("SNAPSPACE_MESHES", default))
    return folder if folder.is_dir() else None


def read(name: str, kind: str, *, quick: bool = False) -> Case:
    """A case by name, with a material by its kind, all moduli 1.

    quick : takes the generated stand-in, which is small, also where there are real meshes
    """
    folder = None if quick else meshes_folder()
    if folder is None:
        return _with_material(_STAND_INS[name](), kind)
    return _with_material(_REAL[name](folder), kind)


def _with_material(case: Case, kind: str) -> Case:
    material, problem = material_class(kind)(), case.problem
    if isinstance(problem, ss.InterpolationProblem):
        return Case(ss.InterpolationProblem(problem.poses, material=material), case.shape)
    changed = ss.PosingProblem(
        problem.mesh,
        problem.handles,
        domain=problem.domain,
        material=material,
        stiffness=problem.stiffness,
    )
    return Case(changed, case.shape)


def _posing(name: str) -> Callable[[Path], Case]:
    def read_it(folder: Path) -> Case:
        return Case(ss.read_problem(folder / "problems" / f"{name}.json"), name)

    return read_it


def scaled(problem: ss.PosingProblem, volume: float, *, stiffness: float) -> ss.PosingProblem:
    """The problem on the same body with another volume; motions grow with it, angles stay."""
    scale = (volume / problem.mesh.volume) ** (1.0 / 3.0)
    bounds = problem.domain.bounds
    return ss.PosingProblem(
        ss.TetMesh(scale * problem.mesh.vertices, problem.mesh.tets),
        problem.handles,
        domain=ss.HandleBox(
            translation=scale * bounds[:, :3], angle=bounds[:, 3:], moving=len(bounds)
        ),
        material=problem.material,
        stiffness=stiffness,
    )


def _armadillo(folder: Path) -> Case:
    """With the paper's volume, and its handle stiffness of 1."""
    problem = ss.read_problem(folder / "problems" / "armadillo.json")
    return Case(scaled(problem, ARMADILLO_VOLUME, stiffness=1.0), "armadillo")


def _helix(folder: Path) -> Case:
    poses = folder / "poses" / "synthetic_helix"
    meshes = [ss.read_tets(poses / f"{name}.mesh") for name in ("cylinder", "helix")]
    return Case(ss.InterpolationProblem(meshes), "helix")


def _creature(*names: str) -> Callable[[], Case]:
    def make() -> Case:
        mesh = generators.creature(5_000)
        parts = generators.creature_handles(mesh)
        handles = ss.Handles([parts[name] for name in names], names=list(names))
        domain = ss.HandleBox(translation=0.3, angle=np.pi / 4)
        problem = ss.PosingProblem(mesh, handles, domain=domain, material=ss.StVK())
        return Case(problem, f"generated creature, {' and '.join(names[1:])}")

    return make


def _small_helix() -> Case:
    poses = [generators.cylinder(2, 26), generators.helix(2, 26)]
    return Case(ss.InterpolationProblem(poses), "generated helix")


_REAL: dict[str, Callable[[Path], Case]] = {
    "dragon": _posing("dragon"),
    "elephant": _posing("elephant"),
    "armadillo": _armadillo,
    "helix": _helix,
}
_STAND_INS: dict[str, Callable[[], Case]] = {
    "dragon": _creature("feet", "head"),
    "elephant": _creature("feet", "tail"),
    "armadillo": _creature("feet", "head", "tail"),
    "helix": _small_helix,
}
