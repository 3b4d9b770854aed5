"""PosingProblem: elastic shapes under moved handles."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable
from dataclasses import replace
from functools import cached_property, partial

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.sparse import csr_array

from .. import _core as core
from ..arguments import as_arrays, as_numbers, as_rows
from ..energy import ElasticEnergy, ShellMaterial
from ..input_error import located
from ..interruptible import run_abandonable
from ..material import Material, checked_material, default_material
from ..mesh import Body, ShellMesh, as_shape, mass_matrix
from ..mesh.frozen import frozen
from .handle_box import HandleBox
from .handle_response import HandleResponse
from .handle_stiffness import checked_stiffness, usual_stiffness
from .handles import Handles
from .held import check_held
from .motion import rigid_offset
from .posing_types import check_posing_types
from .solver_traits import SolverTraits, posing_traits

FloatArray = NDArray[np.float64]


class PosingProblem:
    """Deformation-based modelling as a parametrised minimisation (paper, sec. 3.2).

    F(x, w) = E(x) + stiffness * sum_h sum_{j in h} m_j |v_j - target_j(w)|^2, where m_j is a
    quarter of the volume of the tets at j, or a third of that of the triangles at j. The targets of
    handle h are target_j = R (rest_j - c) + c + t about its mass centroid c.

    Parameters
    ----------
    mesh : TetMesh or ShellMesh
    handles : Handles
        The first one stays at rest while sampling, as do those whose bounds are zero.
    material : Material, default StableNeoHookean(lam=1, mu=1), for shells ARAP(radius=0.02)
        Moduli are numbers, or arrays with one number per tet or triangle. A shell is
        `StableNeoHookean`, `StVK` or `ARAP`, see `ElasticEnergy`; for `ARAP` the thickness is only
        a factor.
    stiffness : float, optional
        Weight of the handles, > 0, in energy per volume and squared length (paper, mu of eq. 2).
        Default: `usual_stiffness`, which follows the size and the moduli of the body.
    domain : HandleBox
        Bounds of the motions; `moving` is set to the number of handles minus one.

    Raises
    ------
    ValueError
        For a mesh, handles or a domain of another type; a stiffness that is not positive; a
        material that is not one of `MATERIALS`, has moduli for another number of tets, or has no
        form for shells; a handle with a vertex that the mesh does not have, or from a mask of
        another length (the message names it); or handles that all lie on one line, about which the
        shape could rotate. Every component of a mesh must be held.
    """

    def __init__(
        self,
        mesh: Body,
        handles: Handles,
        *,
        domain: HandleBox,
        material: Material | None = None,
        stiffness: float | None = None,
    ) -> None:
        check_posing_types(mesh, handles, domain)
        self.mesh = mesh
        self.handles = handles
        if material is None:
            material = default_material(surface=isinstance(mesh, ShellMesh))
        self.material = checked_material(material, len(mesh.cells), "PosingProblem")
        if stiffness is None:
            stiffness = usual_stiffness(mesh, self.material)
        self.stiffness = checked_stiffness(stiffness)
        self.domain = replace(domain, moving=len(handles) - 1)
        with located("PosingProblem"):
            for handle in handles:
                handle.check_in(len(mesh.vertices))
        check_held(mesh, self.pinned, who="PosingProblem")
        self.energy = ElasticEnergy(mesh, self.material)

    def with_handles(self, handles: Handles, *, domain: HandleBox | None = None) -> PosingProblem:
        """The same body, with the same material and stiffness, moved by other handles.

        `carry_over` reuses solutions for the old handles.

        Parameters
        ----------
        handles : Handles
            For example `problem.handles.adding("tail", vertices)`, `without` or `fixing`.
        domain : HandleBox, default that of this problem, see `HandleBox.renamed`

        Returns
        -------
        PosingProblem
            A new problem that shares the mesh and the compiled energy.

        Raises
        ------
        ValueError
            As for the constructor.
        """
        check_posing_types(self.mesh, handles, self.domain if domain is None else domain)
        other = PosingProblem(
            self.mesh,
            handles,
            domain=domain or self.domain.renamed(self.handles.names[1:], handles.names[1:]),
            material=self.material,
            stiffness=self.stiffness,
        )
        other.energy = self.energy
        return other

    @property
    def element_material(self) -> Material | ShellMaterial:
        """The material of the elements."""
        return self.energy.element_material

    @property
    def solving(self) -> SolverTraits:
        """What this problem needs of the solvers."""
        # made anew each time, since a stored one and the problem would keep each other in memory
        return posing_traits(
            self.material,
            shell=isinstance(self.mesh, ShellMesh),
            soft_modes=lambda: self._soft_modes,
            system_near=lambda displacement: self.system,
        )

    @property
    def parameter_count(self) -> int:
        """Number of parameters w."""
        return self.domain.dimension

    @cached_property
    def base(self) -> FloatArray:
        """The rest shape (3n,): solvers work with displacements from it."""
        return self.mesh.vertices.reshape(-1)

    @property
    def tau(self) -> FloatArray:
        """The rest shape (3n,): subspaces go through it (paper, sec. 5)."""
        return self.base

    def mass(self, *, lumped: bool = False) -> csr_array:
        """Mass matrix (n, n) of the rest shape."""
        return mass_matrix(self.mesh, lumped=True) if lumped else self._mass

    @cached_property
    def _mass(self) -> csr_array:
        return mass_matrix(self.mesh)

    @cached_property
    def fingerprint(self) -> str:
        """SHA-256 of everything that solutions depend on, 64 hex digits."""
        content = {
            "kind": "posing",
            "mesh": self.mesh.fingerprint,
            "material": self.material.key,
            "stiffness": self.stiffness,
            "domain": self.domain.half_widths.tolist(),
            "handles": [[handle.name, handle.vertices.tolist()] for handle in self.handles],
        }
        return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()

    @cached_property
    def centroids(self) -> FloatArray:
        """Mass centroids of the handles at rest, (h, 3)."""
        masses, vertices = self.mesh.vertex_masses, self.mesh.vertices
        regions = [handle.vertices for handle in self.handles]
        means = [np.average(vertices[r], axis=0, weights=masses[r]) for r in regions]
        return frozen(np.array(means))

    @cached_property
    def _arms(self) -> list[FloatArray]:
        """Positions of the handles' vertices at rest from their centroids, handle by handle."""
        places = [self.mesh.vertices[handle.vertices] for handle in self.handles]
        return [place - center for place, center in zip(places, self.centroids, strict=True)]

    @cached_property
    def pinned(self) -> NDArray[np.int32]:
        """Vertices of all handles, handle by handle, (p,)."""
        return frozen(np.concatenate([handle.vertices for handle in self.handles]))

    @cached_property
    def pin_weights(self) -> FloatArray:
        """stiffness * m_j of the pinned vertices, (p,)."""
        return frozen(np.multiply(self.stiffness, self.mesh.vertex_masses[self.pinned]))

    @cached_property
    def system(self) -> core.PosingSystem:
        """The compiled problem with its scalar factor, shared by all samples."""
        elastic = self.mesh.vertices, self.energy.corners, self.element_material.core
        pins = self.pinned, self.pin_weights
        return run_abandonable(lambda: core.PosingSystem(*elastic, *pins))

    @cached_property
    def _soft_modes(self) -> core.SoftModes:
        """Soft modes that the scalar factor treats as stiff, for the seed of the fast solver."""
        system = self.system
        return run_abandonable(lambda: core.SoftModes(system))

    @cached_property
    def _response(self) -> HandleResponse:
        return HandleResponse(self)

    def guesses(self, parameters: FloatArray) -> FloatArray:
        """Displacements (k, 3n) near the solutions for samples (k, p), see `HandleResponse`."""
        return self._response.guesses(self, parameters)

    def offsets(self, parameters: ArrayLike) -> FloatArray:
        """Offsets [R - I | t] of all handles, (h, 3, 4), for one parameter vector (p,)."""
        self.check(parameters)
        return np.asarray(self.offsets_of_all(np.asarray(parameters)[None])[0])

    def offsets_of_all(self, parameters: FloatArray) -> FloatArray:
        """Offsets of all handles, (k, h, 3, 4), for samples (k, p)."""
        parameters = as_rows("PosingProblem", "parameters", parameters)
        for w in parameters:
            self.check(w)
        motions = np.pad(parameters.reshape(len(parameters), -1, 6), ((0, 0), (1, 0), (0, 0)))
        return rigid_offset(motions[..., 3:], motions[..., :3])

    def target_displacements(self, offsets: FloatArray) -> FloatArray:
        """Target displacements (..., p, 3) of the pinned vertices for offsets (..., h, 3, 4)."""
        offsets = as_arrays("PosingProblem", "offsets", offsets, len(self.handles), 3, 4)
        turns, shifts = offsets[..., :3].swapaxes(-1, -2), offsets[..., None, :, 3]
        parts = [x @ turns[..., h, :, :] + shifts[..., h, :, :] for h, x in enumerate(self._arms)]
        return np.concatenate(parts, axis=-2)

    def check(self, parameters: ArrayLike) -> None:
        """ValueError for parameters (p,) of another size or not finite; they may leave the box."""
        moving = self.handles.names[1:]
        parameters = as_numbers("PosingProblem", "parameters", parameters)
        if parameters.shape != (self.parameter_count,):
            raise ValueError(
                f"PosingProblem: parameters have shape {parameters.shape}, but {len(moving)} "
                f"moving handles need ({self.parameter_count},): translation, then angles of each"
            )
        if not np.isfinite(parameters).all():
            bad = int(np.flatnonzero(~np.isfinite(parameters))[0])
            entry = ("translation x", "y", "z", "alpha", "beta", "gamma")[bad % 6]
            name = moving[bad // 6]
            raise ValueError(f"PosingProblem: parameter {bad}, {entry} of '{name}', is not finite")

    def inputs(self, parameters: FloatArray) -> FloatArray:
        """Inputs of the system for samples (k, p): pinned displacements, (k, 3 pins)."""
        wanted = self.target_displacements(self.offsets_of_all(parameters))
        return wanted.reshape(len(wanted), -1)

    def known_solutions(self) -> tuple[FloatArray, FloatArray]:
        """Parameters (1, p) and shapes (1, 3n) that need no solving: the rest shape, at zero."""
        return np.zeros((1, self.parameter_count)), self.base[None, :]

    def aligned(self, shape: FloatArray, onto: FloatArray) -> FloatArray:
        """The shape (3n,) itself: handles hold it in its place."""
        return shape

    def registered(self, displacements: FloatArray) -> FloatArray:
        """The displacements (k, 3n) themselves: handles hold the shapes in their place."""
        return displacements

    def handle_energy(self, x: ArrayLike, offsets: FloatArray) -> float:
        """Second term of F (paper, eq. 2) at positions x (3n,) for offsets (h, 3, 4)."""
        return float(self.pin_weights @ (self._misses(x, offsets) ** 2).sum(axis=1))

    def value_and_gradient(self, x: ArrayLike, parameters: ArrayLike) -> tuple[float, FloatArray]:
        """F(x, w) at positions x (3n,) and its gradient (3n,) by x."""
        offsets = self.offsets(parameters)
        elastic, gradient = self.energy.value_and_gradient(x)
        pull = 2.0 * self.pin_weights[:, None] * self._misses(x, offsets)
        np.add.at(gradient.reshape(-1, 3), self.pinned, pull)
        return elastic + self.handle_energy(x, offsets), gradient

    def _misses(self, x: ArrayLike, offsets: FloatArray) -> FloatArray:
        """Vectors from the targets of the pinned vertices to the vertices, (p, 3)."""
        shape = as_shape(x, self.base.size, who="PosingProblem")
        moved = shape.reshape(-1, 3)[self.pinned]
        wanted = self.mesh.vertices[self.pinned] + self.target_displacements(offsets)
        return np.asarray(moved - wanted)

    def __reduce__(self) -> tuple[Callable[..., PosingProblem], tuple[Body, Handles]]:
        # pickles the definition; the compiled system and other caches are made again where needed
        made = partial(
            PosingProblem, domain=self.domain, material=self.material, stiffness=self.stiffness
        )
        return made, (self.mesh, self.handles)

    def __repr__(self) -> str:
        return f"PosingProblem({self.mesh!r}, {self.handles!r}, stiffness {self.stiffness:g})"
