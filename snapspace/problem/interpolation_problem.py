"""InterpolationProblem: elastic shapes between several poses."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Sequence
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.sparse import csr_array

from .. import _core as core
from ..arguments import as_numbers
from ..energy import PoseEnergies, ShellMaterial, is_of_stars
from ..interruptible import run_abandonable
from ..material import Material, checked_material, default_material
from ..mesh import ShellMesh, TetMesh, mass_matrix, mass_of_cells, tet_volumes, triangle_areas
from ..mesh.frozen import frozen
from ..mesh.shape_rows import as_shape
from ..registration import registered
from .blends import shape_and_weights
from .certain_range import CertainRange, certain_range
from .mean_shape import checked_mean_shape, mean_displacement
from .pose_sets import as_poses, pose_arguments, restored_poses
from .poses import Poses
from .shell_poses import ShellPoses
from .simplex import Simplex
from .solver_traits import SolverTraits, interpolation_traits
from .triangle_range import triangle_range

FloatArray = NDArray[np.float64]


class InterpolationProblem:
    """Shape interpolation as a parametrised minimisation (paper, sec. 3.3).

    F(x, w) = sum_k w_k E_k(x), where E_k is the elastic energy with pose k as its rest shape. The
    weights w are not negative and sum to one. F is invariant under rigid motions of x, so all
    solutions are registered rigidly to the mean shape. The mean shape is the solution for equal
    weights, in the frame of the first pose.

    Parameters
    ----------
    poses : Poses or ShellPoses, or a sequence of TetMesh or of ShellMesh
        Two or more; each may be in its own frame.
    material : Material, default StableNeoHookean(lam=1, mu=1), for shells ARAP(radius=0.05)
        Any of `MATERIALS`; for shells ARAP, StableNeoHookean or StVK. Moduli are numbers, or arrays
        with one number per tet or triangle. Blends of ARAP are unique where others crumple, see
        docs/materials.md.
    extrapolation : float, default 0
        Enlarges the sampled simplex by this share about its centre. Outside the simplex F may have
        no minimum; such samples are reported as not converged.
    mean_shape : array_like, (3n,) or (n, 3), optional
        The mean shape, if it is known, as from a model file. Default: computed when it is first
        needed.

    Raises
    ------
    ValueError
        As for `Poses.of` and `ShellPoses.of`, and for moduli of another number of tets, a negative
        extrapolation, or a mean shape of other dimensions.

    Notes
    -----
    A parameter vector holds one weight per pose.
    """

    def __init__(
        self,
        poses: Poses | ShellPoses | Sequence[TetMesh] | Sequence[ShellMesh],
        *,
        material: Material | None = None,
        extrapolation: float = 0.0,
        mean_shape: ArrayLike | None = None,
    ) -> None:
        self.poses = as_poses(poses)
        mesh = self.mesh
        if material is None:
            material = default_material(surface=isinstance(mesh, ShellMesh), blended=True)
        self.material = checked_material(material, len(mesh.cells), "InterpolationProblem")
        self.domain = Simplex(corners=len(self.poses), extrapolation=extrapolation)
        if mean_shape is not None:
            self.mean_shape = checked_mean_shape(mean_shape, len(self.base))

    @property
    def mesh(self) -> TetMesh | ShellMesh:
        """The first pose."""
        return self.poses.reference

    @property
    def solving(self) -> SolverTraits:
        """What this problem needs of the solvers."""
        # made anew each time, since a stored one and the problem would keep each other in memory
        shell = isinstance(self.mesh, ShellMesh)
        return interpolation_traits(self.material, shell=shell, system_near=self._system_near)

    @property
    def parameter_count(self) -> int:
        """Number of weights, one per pose."""
        return len(self.poses)

    @property
    def base(self) -> FloatArray:
        """The first pose (3n,): solvers work with displacements from it."""
        base: FloatArray = self.poses.shapes[0].reshape(-1)
        return base

    @property
    def tau(self) -> FloatArray:
        """The mean shape (3n,): subspaces go through it (paper, sec. 5)."""
        return self.mean_shape

    @cached_property
    def system(self) -> core.InterpolationSystem:
        """The compiled problem, with a scalar factor for shapes near the mean."""
        return self._system_near(self.mean_shape - self.base)

    @cached_property
    def mean_shape(self) -> FloatArray:
        """The solution for equal weights (3n,), registered to the first pose (paper, sec. 4.3).

        Raises
        ------
        ValueError
            If no solve converges.
        KeyboardInterrupt
            On Ctrl-C.
        """
        return self._solved_mean_shape(threads=0)

    def solve_mean_shape(self, *, threads: int | None = None) -> None:
        """Solves for `mean_shape` now, unless it is known; `threads`: how many, default all."""
        if "mean_shape" not in self.__dict__:
            self.mean_shape = self._solved_mean_shape(threads=threads or 0)

    @property
    def spread(self) -> float:
        """Largest distance of a vertex in the first pose from another pose, registered to it."""
        offsets = (self._near_poses - self.base).reshape(len(self.poses), -1, 3)
        return float(np.linalg.norm(offsets, axis=2).max())

    @cached_property
    def pose_shapes(self) -> FloatArray:
        """The poses registered to the mean shape, (k, 3n): the solutions for one-hot weights."""
        flat = self.poses.shapes.reshape(len(self.poses), -1)
        return frozen(registered(flat, self.tau, self._mean_mass))

    @cached_property
    def certain_range(self) -> CertainRange | None:
        """Weights for which F certainly has a minimum, by all tets; None if no test is known.

        A reduced model has its own, larger range: its energy has fewer tets.
        """
        corners = self.poses.shapes[:, self.mesh.cells]
        if is_of_stars(self.mesh, self.material):
            return triangle_range(corners)
        return certain_range(self.material, corners) if isinstance(self.mesh, TetMesh) else None

    @cached_property
    def element_material(self) -> Material | ShellMaterial:
        """The material of the elements of the first pose."""
        return self._given_energies.materials[0]

    @cached_property
    def pose_energies(self) -> PoseEnergies:
        """The energies E_k of the poses registered to the mean shape."""
        return self._given_energies.in_frames(self.pose_shapes.reshape(self.poses.shapes.shape))

    @cached_property
    def _given_energies(self) -> PoseEnergies:
        return PoseEnergies(self.mesh, self.poses.shapes, self.material)

    @cached_property
    def fingerprint(self) -> str:
        """SHA-256 of everything that solutions depend on, 64 hex digits."""
        content = {
            "kind": "interpolation",
            "mesh": self.mesh.fingerprint,
            "material": self.material.key,
            "extrapolation": self.domain.extrapolation,
        }
        digest = hashlib.sha256(json.dumps(content, sort_keys=True).encode())
        digest.update(self.poses.shapes.astype("<f8", copy=False).tobytes())
        return digest.hexdigest()

    def mass(self, *, lumped: bool = False) -> csr_array:
        """Mass matrix (n, n) of the mean shape; an inverted tet counts with its absolute volume."""
        return self._mass_of(self.tau, lumped=True) if lumped else self._mean_mass

    def volumes(self, x: ArrayLike) -> FloatArray:
        """Signed volumes (m,) of tets, or areas times thickness, at positions (3n,) or (n, 3)."""
        vertices = as_shape(x, self.base.size, who="InterpolationProblem").reshape(-1, 3)
        if isinstance(self.mesh, ShellMesh):
            return np.asarray(triangle_areas(vertices, self.mesh.cells) * self.mesh.thickness)
        return tet_volumes(vertices, self.mesh.cells)

    def check(self, parameters: FloatArray) -> None:
        """ValueError unless the weights (p,) are in the domain."""
        self.weights(parameters)

    def inputs(self, parameters: FloatArray) -> FloatArray:
        """Inputs of the system for samples (k, p): the weights themselves."""
        return np.ascontiguousarray(parameters)

    def weights(self, parameters: ArrayLike, *, extrapolate: bool = False) -> FloatArray:
        """The weights (p,), if they are in the domain or `extrapolate` is set; else ValueError."""
        return self.domain.check(parameters, extrapolate=extrapolate, who="InterpolationProblem")

    def known_solutions(self) -> tuple[FloatArray, FloatArray]:
        """Weights (p + 1, p) and shapes (p + 1, 3n) of the mean shape and of all poses."""
        weights = np.vstack([self.domain.center, np.eye(len(self.poses))])
        return weights, np.vstack([self.tau, self.pose_shapes])

    def aligned(self, shape: FloatArray, onto: FloatArray) -> FloatArray:
        """A shape (3n,) after rigid registration onto another one, in the M-norm."""
        return registered(shape, onto, self._mean_mass)

    def registered(self, displacements: FloatArray) -> FloatArray:
        """Displacements (k, 3n) of the same shapes after registration to the mean shape."""
        displacements = as_numbers("InterpolationProblem", "displacements", displacements)
        moved = registered(displacements + self.base, self.tau, self._mean_mass)
        moved -= self.base
        return moved

    def guesses(self, parameters: FloatArray) -> None:
        """Always None: there are no guesses for blends."""

    def value_and_gradient(self, x: ArrayLike, weights: ArrayLike) -> tuple[float, FloatArray]:
        """F(x, w) at positions x (3n,) for any weights (p,), and its gradient (3n,) by x."""
        positions, w = shape_and_weights(x, weights, self.base.size, self.parameter_count)
        value, gradient = self.system.value_and_gradient(positions - self.base, w)
        return value, gradient

    def pose_energy(self, pose: int) -> core.ElasticEnergy:
        """E_k of a pose registered to the mean shape, a function of displacements from there."""
        return self.pose_energies.energy(pose)

    def linear_blend(self, weights: ArrayLike, *, extrapolate: bool = False) -> FloatArray:
        """Vertices (n, 3) of sum_k w_k pose_k, the linear blend of the registered poses."""
        w = self.weights(weights, extrapolate=extrapolate)
        blend: FloatArray = np.einsum("k,ki->i", w, self.pose_shapes).reshape(-1, 3)
        return blend

    def _solved_mean_shape(self, *, threads: int) -> FloatArray:
        poses = self._near_poses - self.base
        mean = self.base + mean_displacement(self._rest_system, poses, threads=threads)
        return frozen(registered(mean, self.base, self._mass_of(mean)))

    @cached_property
    def _rest_system(self) -> core.InterpolationSystem:
        # energies do not depend on the poses' frames, but differences lose digits far from the
        # origin
        shapes = self._near_poses.reshape(self.poses.shapes.shape)
        parts = self._given_energies.corners, self.element_material.core
        return run_abandonable(lambda: core.InterpolationSystem(shapes, *parts))

    def _system_near(self, displacement: FloatArray) -> core.InterpolationSystem:
        """The system with a factor for solutions near a displacement (3n,)."""
        rest, shapes = self._rest_system, np.ascontiguousarray(displacement)[None, :]
        return run_abandonable(lambda: rest.adapted(shapes, self.domain.center[None]))

    @cached_property
    def _mean_mass(self) -> csr_array:
        return self._mass_of(self.tau)

    @cached_property
    def _near_poses(self) -> FloatArray:
        """The poses registered to the first one, (k, 3n); the first is itself."""
        flat = self.poses.shapes.reshape(len(self.poses), -1)
        near = registered(flat, self.base, mass_matrix(self.mesh))
        near[0] = self.base
        return near

    def _mass_of(self, shape: FloatArray, *, lumped: bool = False) -> csr_array:
        return mass_of_cells(self.mesh.cells, np.abs(self.volumes(shape)), lumped=lumped)

    def __reduce__(self) -> tuple[Callable[..., InterpolationProblem], tuple[Any, ...]]:
        # pickles the definition, and the mean shape if it is known because it takes long to find.
        # The compiled system and other caches are made again where needed
        poses, mean_shape = pose_arguments(self.poses), vars(self).get("mean_shape")
        return _restored, (poses, self.material, self.domain.extrapolation, mean_shape)

    def __repr__(self) -> str:
        return f"InterpolationProblem({self.poses!r})"


def _restored(
    poses: tuple[Any, ...], material: Material, extrapolation: float, mean_shape: FloatArray | None
) -> InterpolationProblem:
    """The problem from a pickle, checked again and with read-only arrays."""
    return InterpolationProblem(
        restored_poses(*poses),
        material=material,
        extrapolation=extrapolation,
        mean_shape=mean_shape,
    )
