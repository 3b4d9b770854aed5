"""carry_over: turns solutions for some handles into snapshots of a problem with other handles."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array, diags_array

from ..blas import single_threaded_blas
from ..displacements import DisplacementRows
from ..problem import PosingProblem, Problem, euler_of_rotation, require_problem, rotation_matrix
from ..registration import RigidMotion, rigid_registration
from .snapshots import SampleReport, Snapshots, check_snapshots

FloatArray = NDArray[np.float64]


@single_threaded_blas
def carry_over(snapshots: Snapshots, problem: PosingProblem) -> Snapshots:
    """Converts snapshots to a problem with other handles, as starts and for its basis.

    Each shape gets the parameters of the new problem that fit it best. A handle with the same
    vertices as an old one keeps its motion. Any other handle gets the rigid motion that brings its
    rest vertices closest to the shape's, weighted by mass; this motion has the least energy. If the
    new problem fixes another handle, the shape is moved back rigidly by the motion of that handle,
    and all motions are relative to it. This does not change the objective.

    Parameters
    ----------
    snapshots : Snapshots
        Snapshots of a `PosingProblem`. Those that are not usable are left out.
    problem : PosingProblem
        A problem with the same mesh, usually from `with_handles`. Material and stiffness may
        differ.

    Returns
    -------
    Snapshots
        Snapshots of `problem`; parameters may lie outside its box. If the problem has the same
        handles in another order, with other names or in another box, the shapes are its solutions
        and keep their reports. Otherwise the status of the reports is "carried", and their numbers
        are zero.

    Raises
    ------
    ValueError
        For another mesh, another kind of problem, or if no snapshot is usable.

    Notes
    -----
    A handle whose vertices lie on a line or in a point does not determine its rotation, and the
    objective does not depend on the undetermined part. The handle gets the smallest rotation
    relative to the fixed handle. Rotations are fitted after Kabsch 1976, see `rigid_registration`.

    An added handle hardly pulls. On the creature a solve from such a shape at its own parameters
    takes 2 iterations, and 25 new samples with 100 carried ones are as good as 50 new ones (on the
    Dragon, as 100). If a handle is removed, its force is missing: the shapes improve a basis from
    few new samples, but as starts they are no better than the rest shape.
    """
    old = _checked(snapshots, problem)
    known = snapshots.select(snapshots.usable)
    carrier = _Carrier(old, problem)
    motions = known.parameters.reshape(len(known), -1, 6)
    shapes = (old.base + row for row in known.displacements)
    samples = [carrier.carry(m, x) for m, x in zip(motions, shapes, strict=True)]
    parameters = np.array([parameters for parameters, _ in samples])
    moved = [shape - problem.base for _, shape in samples if shape is not None]
    carried = unsolved_snapshots(problem, parameters, moved or known.displacements)
    return replace(carried, reports=known.reports) if _same_objective(old, problem) else carried


def unsolved_snapshots(
    problem: Problem, parameters: FloatArray, displacements: Iterable[FloatArray]
) -> Snapshots:
    """Snapshots whose shapes were not solved for their parameters: their status is "carried".

    displacements : rows (3n,), as for `DisplacementRows`
    """
    if not isinstance(displacements, DisplacementRows):
        displacements = DisplacementRows(displacements, problem.base.size)
    report = SampleReport("carried", 0, 0, 0.0, 0.0, 0.0, 0.0, 0)
    return Snapshots(problem, parameters, displacements, [report] * len(parameters))


class _Carrier:
    """Turns motions and shapes of an old problem into those of a new one."""

    def __init__(self, old: PosingProblem, new: PosingProblem) -> None:
        self._old, self._new = old, new
        self._places = new.handles.places_in(old.handles)
        masses = new.mesh.vertex_masses
        self._masses = [csr_array(diags_array(masses[handle.vertices])) for handle in new.handles]

    def carry(self, moving: FloatArray, shape: FloatArray) -> tuple[FloatArray, FloatArray | None]:
        """Parameters (p,) and positions (3n,), from motions (h - 1, 6) and positions (3n,).

        None for positions that stay because the first handle stays.
        """
        motions = np.vstack([np.zeros(6), moving])
        moves = self._places[0] != 0  # otherwise known values stay bitwise the same
        if moves:
            back = self._first_motion(motions, shape).inverse()
            shape = back.apply(shape)
            pairs = zip(motions, self._old.centroids, strict=True)
            motions = np.array([_parameters(_composed(back, _rigid(m, c)), c) for m, c in pairs])
        parameters = [
            _parameters(self._fit(h, shape), self._new.centroids[h])
            if place is None
            else motions[place]
            for h, place in enumerate(self._places)
            if h > 0
        ]
        return np.concatenate(parameters), shape if moves else None

    def _first_motion(self, motions: FloatArray, shape: FloatArray) -> RigidMotion:
        """The motion, in the old problem, of the handle that the new problem fixes."""
        place = self._places[0]
        if place is None:
            return self._fit(0, shape)
        return _rigid(motions[place], self._old.centroids[place])

    def _fit(self, h: int, shape: FloatArray) -> RigidMotion:
        """The motion from rest that brings a handle of the new problem closest to a shape."""
        vertices = self._new.handles[h].vertices
        rest, there = self._new.mesh.vertices[vertices], shape.reshape(-1, 3)[vertices]
        return rigid_registration(rest.reshape(-1), there.reshape(-1), self._masses[h])


def _rigid(motion: FloatArray, center: FloatArray) -> RigidMotion:
    """The map of positions for translation and Euler angles (6,) about a center."""
    rotation = rotation_matrix(motion[3:])
    return RigidMotion(rotation, center + motion[:3] - rotation @ center)


def _parameters(motion: RigidMotion, center: FloatArray) -> FloatArray:
    """Translation and Euler angles (6,) about a center: the inverse of `_rigid`."""
    shift = motion.apply(center[None])[0] - center
    return np.concatenate([shift, euler_of_rotation(motion.rotation)])


def _composed(second: RigidMotion, first: RigidMotion) -> RigidMotion:
    """The first motion, followed by the second one."""
    shift = second.apply(first.translation[None])[0]
    return RigidMotion(second.rotation @ first.rotation, shift)


def _same_objective(old: PosingProblem, new: PosingProblem) -> bool:
    """Whether solutions of one problem are, up to a rigid motion, solutions of the other."""
    same_weights = (old.material, old.stiffness) == (new.material, new.stiffness)
    same_number = len(old.handles) == len(new.handles)
    return same_weights and same_number and None not in new.handles.places_in(old.handles)


def _checked(snapshots: Snapshots, problem: PosingProblem) -> PosingProblem:
    check_snapshots(snapshots, "carry_over")
    require_problem(problem, "carry_over")
    old = snapshots.problem
    for what, one in (("the problem of the snapshots", old), ("the problem", problem)):
        if not isinstance(one, PosingProblem):
            raise ValueError(
                f"carry_over: {what} is an {type(one).__name__}, "
                "but only a PosingProblem has handles"
            )
    assert isinstance(old, PosingProblem)
    if old.mesh.fingerprint != problem.mesh.fingerprint:
        raise ValueError(
            f"carry_over: the snapshots are of {old.mesh!r}, but the problem is on another mesh, "
            f"{problem.mesh!r}; make it with snapshots.problem.with_handles"
        )
    if not snapshots.usable.any():
        raise ValueError(
            f"carry_over: none of the {len(snapshots)} snapshots converged; allow more iterations "
            "or choose a smaller domain"
        )
    return old
