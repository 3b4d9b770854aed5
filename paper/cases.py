"""Cases: the paper's problems by name, on real meshes or on generated stand-ins."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path

import numpy as np

import snapspace as ss
from snapspace import generators
from snapspace.material import material_class

from .cached import FOLDER
from .fitted import fitted_poses

#: The paper's material, and the default of Snapspace.
MATERIALS = ("stvk", "stable-neo-hookean")
#: Volume of the Armadillo in the paper.
ARMADILLO_VOLUME = 234741.0


@dataclass(frozen=True)
class Case:
    """A problem, and the name of its shape.

    shape : name of a real mesh, or "generated ..." for a stand-in
    fitting : seconds that fitting the tets to the poses' surfaces took; None if the poses are tets,
        or there are none
    """

    problem: ss.PosingProblem | ss.InterpolationProblem
    shape: str
    fitting: float | None = None

    @property
    def generated(self) -> bool:
        """Whether this is a stand-in."""
        return self.shape.startswith("generated")


def meshes_folder() -> Path | None:
    """The folder of real meshes, SNAPSPACE_MESHES or ../shared/meshes; None if there is none."""
    default = Path(__file__).parents[2] / "shared" / "meshes"
    folder = Path(os.environ.get("SNAPSPACE_MESHES", default))
    return folder if folder.is_dir() else None


def read(name: str, kind: str, *, quick: bool = False) -> Case:
    """A case by name, with a material by its kind, all moduli 1.

    quick : take the small generated stand-in even if there are real meshes
    """
    folder = None if quick else meshes_folder()
    if folder is None:
        return _with_material(_STAND_INS[name](), kind)
    return _with_material(_REAL[name](folder), kind)


def _with_material(case: Case, kind: str) -> Case:
    material, problem = material_class(kind)(), case.problem
    if isinstance(problem, ss.InterpolationProblem):
        return replace(case, problem=ss.InterpolationProblem(problem.poses, material=material))
    changed = ss.PosingProblem(
        problem.mesh,
        problem.handles,
        domain=problem.domain,
        material=material,
        stiffness=problem.stiffness,
    )
    return replace(case, problem=changed)


def _posing(name: str) -> Callable[[Path], Case]:
    def read_it(folder: Path) -> Case:
        shape = name.replace("_", " ")
        return Case(ss.read_problem(folder / "problems" / f"{name}.json"), shape)

    return read_it


def scaled(problem: ss.PosingProblem, volume: float, *, stiffness: float) -> ss.PosingProblem:
    """The problem on the same body with another volume; motions grow with it, angles stay."""
    scale = (volume / problem.mesh.volume) ** (1.0 / 3.0)
    bounds = problem.domain.bounds
    return ss.PosingProblem(
        ss.TetMesh(scale * problem.mesh.vertices, problem.mesh.cells),
        problem.handles,
        domain=ss.HandleBox(
            translation=scale * bounds[:, :3], angle=bounds[:, 3:], moving=len(bounds)
        ),
        material=problem.material,
        stiffness=stiffness,
    )


def _armadillo(folder: Path) -> Case:
    """The Armadillo with the paper's volume and its handle stiffness of 1."""
    problem = ss.read_problem(folder / "problems" / "armadillo.json")
    return Case(scaled(problem, ARMADILLO_VOLUME, stiffness=1.0), "armadillo")


def _helix(folder: Path) -> Case:
    poses = folder / "poses" / "synthetic_helix"
    meshes = [ss.read_tets(poses / f"{name}.mesh") for name in ("cylinder", "helix")]
    return Case(ss.InterpolationProblem(meshes), "helix")


def _poses(shape: str, tets: str, reference: str, *names: str) -> Callable[[Path], Case]:
    def read_it(folder: Path) -> Case:
        found = fitted_poses(
            folder / "tets" / tets, folder / "poses" / reference, names, folder=FOLDER
        )
        return Case(ss.InterpolationProblem(found.poses), shape, found.seconds)

    return read_it


@cache
def _creature_mesh() -> ss.TetMesh:
    return generators.creature(5_000)


def _creature(*names: str) -> Callable[[], Case]:
    def make() -> Case:
        mesh = _creature_mesh()
        parts = generators.creature_handles(mesh)
        handles = ss.Handles([parts[name] for name in names], names=list(names))
        domain = ss.HandleBox(translation=0.3, angle=np.pi / 4)
        problem = ss.PosingProblem(mesh, handles, domain=domain, material=ss.StVK())
        return Case(problem, f"generated creature, {' and '.join(names[1:])}")

    return make


def _small_helix() -> Case:
    poses = [generators.cylinder(2, 26), generators.helix(2, 26)]
    return Case(ss.InterpolationProblem(poses), "generated helix")


def _lizard(poses: int) -> Callable[[], Case]:
    def make() -> Case:
        problem = ss.InterpolationProblem(generators.lizard_poses(poses, 2_000, seed=poses))
        return Case(problem, f"generated lizard, {poses} poses")

    return make


_REAL: dict[str, Callable[[Path], Case]] = {
    "dragon": _posing("dragon"),
    "elephant": _posing("elephant"),
    "armadillo": _armadillo,
    "dog_head": _posing("dog_head"),
    "spot": _posing("spot"),
    "helix": _helix,
    "lion": _poses(
        "lion", "sumner_lion_Yq1.4a.mesh", "sumner_lion/lion-reference_fixed.off", "lion-06"
    ),
    "dog": _poses("dog", "tosca_dog_Yq2.mesh", "tosca_dog/dog0.off", "dog1", "dog2"),
    "centaur": _poses(
        "centaur",
        "tosca_centaur_Yq2.mesh",
        "tosca_centaur/centaur0_fixed.off",
        *(f"centaur{k}" for k in range(1, 6)),
    ),
}
#: Names of all cases.
CASES = tuple(_REAL)
_STAND_INS: dict[str, Callable[[], Case]] = {
    "dragon": _creature("feet", "head"),
    "elephant": _creature("feet", "tail"),
    "armadillo": _creature("feet", "head", "tail"),
    "dog_head": _creature("feet", "head"),
    "spot": _creature("feet", "head"),
    "helix": _small_helix,
    "lion": _lizard(2),
    "dog": _lizard(3),
    "centaur": _lizard(6),
}
