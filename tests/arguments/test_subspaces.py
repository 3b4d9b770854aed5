"""Wrong arguments of subspaces, symmetry and validation are refused in one line."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

import snapspace as ss

from .refused import Call, check_refused, refusals

PLANE = ss.MirrorPlane((0, 1, 0))


def pca(snapshots: Any, **changed: Any) -> ss.AffineSubspace:
    problem = snapshots.problem
    parts = {"shapes": snapshots.shapes, "tau": problem.tau, "mass": problem.mass(), "dimension": 3}
    parts |= changed
    return ss.pca(parts.pop("shapes"), parts.pop("tau"), parts.pop("mass"), **parts)


WRONG: dict[str, tuple[Call, str]] = {
    "a basis as lists": (
        lambda m, s: replace(m.subspace, basis=m.subspace.basis.tolist()),
        "AffineSubspace: basis is of type list; give an array of 2 axes",
    ),
    "a basis as rows": (
        lambda m, s: replace(m.subspace, basis=m.subspace.basis.T),
        "AffineSubspace: the basis is (20, 243), but tau has 243 coordinates; give (243, d), one",
    ),
    "complex vibration modes": (
        lambda m, s: replace(m.subspace, basis=m.subspace.basis * 1j),
        "AffineSubspace: basis must be numbers with 2 axes, got complex128 of shape (243, 20)",
    ),
    "a dense mass matrix of a subspace": (
        lambda m, s: replace(m.subspace, mass=m.subspace.mass.toarray()),
        "AffineSubspace: mass is of type ndarray; give mass_matrix(mesh) or problem.mass()",
    ),
    "a mass matrix in another format": (
        lambda m, s: pca(s, mass=s.problem.mass().tocoo()),
        "pca: mass is of type coo_array; give scipy.sparse.csr_array(mass)",
    ),
    "a basis to widen": (
        lambda m, s: ss.widen(m.subspace.basis, s, dimension=30),
        "widen: subspace is of type ndarray; give that of snapshot_pca or affine_subspace",
    ),
    "shapes to widen by": (
        lambda m, s: ss.widen(m.subspace, s.shapes, dimension=30),
        "widen: snapshots is of type ndarray; give subspace, snapshots",
    ),
    "half a dimension": (
        lambda m, s: ss.widen(m.subspace, s, dimension=2.5),  # type: ignore[arg-type]
        "widen: dimension is 2.5, but must be a whole number",
    ),
    "rows of two lengths as windows": (
        lambda m, s: ss.widen(m.subspace, s, dimension=30, windows=[[1.0, 2.0], [3.0]]),  # type: ignore[arg-type]
        "widen: windows must be numbers, in rows of one length, but are of type list",
    ),
    "a weight in words": (
        lambda m, s: ss.widen(m.subspace, s, dimension=30, handle_weight="x"),  # type: ignore[arg-type]
        "widen: handle_weight is 'x', but must be finite and not negative",
    ),
    "windows of a model": (
        lambda m, s: ss.handle_windows(m),
        "handle_windows: problem is of type PosingModel; give its problem, .problem",
    ),
    "windows of a session": (
        lambda m, s: ss.handle_windows(m.session()),  # type: ignore[arg-type]
        "handle_windows: problem is of type PosingSession; give its problem, .model.problem",
    ),
    "windows of a mesh": (
        lambda m, s: ss.handle_windows(s.problem.mesh),
        "handle_windows: problem is of type TetMesh; give a PosingProblem: only that has handles",
    ),
    "directions of a mesh": (
        lambda m, s: ss.affine_subspace(m.subspace.basis, s.problem.mesh),
        "affine_subspace: problem is of type TetMesh; give a PosingProblem or Interpolation",
    ),
    "a share in words": (
        lambda m, s: ss.affine_subspace(m.subspace.basis, s.problem, rtol="x"),  # type: ignore[arg-type]
        "affine_subspace: rtol is 'x', but it must be between 0 and 1",
    ),
    "a mesh in place of tau": (
        lambda m, s: pca(s, tau=s.problem.mesh),
        "pca: tau must be numbers, in rows of one length, but are of type TetMesh",
    ),
    "a tau that is not finite": (
        lambda m, s: pca(s, tau=np.full(s.problem.tau.size, np.nan)),
        "pca: tau has shape (",
    ),
    "a dense mass matrix": (
        lambda m, s: pca(s, mass=s.problem.mass().toarray()),
        "pca: mass is of type ndarray; give mass_matrix(mesh) or problem.mass()",
    ),
    "the mass of another mesh": (
        lambda m, s: pca(s, mass=s.problem.mass()[:3, :3]),
        "pca: mass has shape (3, 3), but must be (",
    ),
    "a fraction in words": (
        lambda m, s: pca(s, dimension=None, energy_fraction="x"),
        "pca: energy_fraction is 'x', but must be in (0, 1]",
    ),
    "a matrix as Gram matrix": (
        lambda m, s: ss.snapshot_pca(s, dimension=3, gram=np.eye(60)),  # type: ignore[arg-type]
        "snapshot_pca: gram is of type ndarray; give SnapshotGram.of(problem)",
    ),
    "a dimension in words": (
        lambda m, s: m.leading("x"),
        "AffineSubspace: dimension is of type str; give a whole number",
    ),
    "half a dimension of a subspace": (
        lambda m, s: m.subspace.leading(1.5),
        "AffineSubspace: dimension is of type float; give a whole number",
    ),
    "too many coordinates": (
        lambda m, s: m.subspace.shape(np.zeros(21)),
        "AffineSubspace.shape: q has shape (21,), but must be (20,) or shorter; shapes takes rows",
    ),
    "one row of coordinates": (
        lambda m, s: m.subspace.shapes(np.zeros(20)),
        "AffineSubspace.shapes: coordinates have shape (20,), but must be (k, 20)",
    ),
    "shapes as displacements": (
        lambda m, s: m.subspace.row_coordinates(s.shapes),
        "row_coordinates: displacements is of type ndarray; give snapshots.displacements",
    ),
    "a problem to advise on": (
        lambda m, s: ss.next_option(s.problem, None),  # type: ignore[arg-type]
        "next_option: model is of type PosingProblem; give that of reduce or load",
    ),
    "no split to advise by": (
        lambda m, s: ss.next_option(m, ss.Certificate(0, 0, 0, 0, 0.9, 0)),  # type: ignore[arg-type]
        "next_option: split is of type Certificate; give that of split_errors",
    ),
    "half a sample to validate with": (
        lambda m, s: ss.validate(m, samples=1.5),  # type: ignore[arg-type]
        "validate: the number of samples is 1.5, but must be a whole number",
    ),
    "a negative seed to validate with": (
        lambda m, s: ss.validate(m, samples=1, seed=-1),
        "validate: the seed is -1, but must be at least 0",
    ),
    "a seed in words to calibrate with": (
        lambda m, s: ss.calibrate(m, samples=2, seed="x"),  # type: ignore[arg-type]
        "calibrate: seed is 'x', but must be a whole number",
    ),
    "one dimension of a curve": (
        lambda m, s: ss.error_curve(m, dimensions=3),  # type: ignore[arg-type]
        "error_curve: dimensions is of type int; give a list, such as [10, 20]",
    ),
    "dimensions in words": (
        lambda m, s: ss.error_curve(m, dimensions=["x"]),  # type: ignore[list-item]
        "error_curve: a dimension is 'x', but must be a whole number",
    ),
    "a mesh to mirror": (
        lambda m, s: ss.mirror_handle(s.problem.mesh, "head"),
        "mirror_handle: problem is of type TetMesh; give a PosingProblem",
    ),
    "the number of a handle to mirror": (
        lambda m, s: ss.mirror_handle(s.problem, 1),  # type: ignore[arg-type]
        "there is no handle '1'; the handles are foot, head, belly",
    ),
    "a normal as plane": (
        lambda m, s: ss.mirror_handle(s.problem, "head", plane=(0, 1, 0)),  # type: ignore[arg-type]
        "mirror_handle: plane is of type tuple; give MirrorPlane(normal, point)",
    ),
    "a model to mirror": (
        lambda m, s: ss.mirror_pose(m),
        "mirror_pose: session is of type PosingModel; give model.session()",
    ),
    "a normal to pose by": (
        lambda m, s: ss.mirror_pose(m.session(), plane=(0, 1, 0)),  # type: ignore[arg-type]
        "counterparts: plane is of type tuple; give MirrorPlane(normal, point)",
    ),
    "counterparts in a model": (
        lambda m, s: ss.counterparts(m, PLANE),
        "counterparts: problem is of type PosingModel; give its problem, .problem",
    ),
    "a region without a plane": (
        lambda m, s: ss.mirrored_region(s.problem.mesh.vertices, s.problem.mesh.surface, [0], None),  # type: ignore[arg-type]
        "mirrored_region: plane is of type NoneType; give MirrorPlane(normal, point)",
    ),
    "faces beyond the vertices": (
        lambda m, s: ss.mirrored_region(np.eye(3), [[0, 1, 9]], [0], PLANE),  # type: ignore[arg-type]
        "mirrored_region: face 0 has vertex index 9, but vertices has 3 rows",
    ),
    "the number of a name": (
        lambda m, s: ss.mirrored_name(3),  # type: ignore[arg-type]
        "mirrored_name: name is of type int; give the name of a handle",
    ),
    "vectors of two entries": (
        lambda m, s: PLANE.vectors([[1.0, 2.0]]),
        "MirrorPlane: vectors have shape (1, 2), but must be (..., 3)",
    ),
    "a matrix as normal": (
        lambda m, s: ss.MirrorPlane(np.eye(3)),  # type: ignore[arg-type]
        "MirrorPlane: the normal must be three finite numbers, got an array of shape (3, 3)",
    ),
}


test_a_wrong_argument_is_refused_in_one_line = refusals(WRONG)


def test_blends_have_no_windows(blending_model: ss.InterpolationModel) -> None:
    problem: Any = blending_model.problem
    message = "handle_windows: problem is of type InterpolationProblem; give a PosingProblem"
    check_refused(lambda: ss.handle_windows(problem), message)


def test_a_cubature_has_its_dimensions(cubature_model: ss.PosingModel) -> None:
    cubature: Any = cubature_model.cubature
    for dimension in (0, 20, "x", None):
        check_refused(lambda d=dimension: cubature.leading(d), "Cubature: dimension ")
    for q in (np.zeros(3), "x", None, np.zeros((19, 19))):
        check_refused(lambda q=q: cubature.hessian(q), "Cubature: q ")
    check_refused(lambda: replace(cubature_model).leading(np.nan), "AffineSubspace: dimension is")
