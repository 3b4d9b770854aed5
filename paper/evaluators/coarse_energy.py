"""Mesh coarsening: the energy of a coarsened mesh that carries the same modes."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

import snapspace as ss
from snapspace import _core as core
from snapspace.cubature.displacement_gradients import displacement_gradients
from snapspace.mesh import tet_volumes
from snapspace.reduction import BlendedCubature, Cubature, FullBlends, FullEnergy

from .edge_collapse import CoarseMesh

FloatArray = NDArray[np.float64]


def coarse_model(
    model: ss.PosingModel | ss.InterpolationModel, coarse: CoarseMesh
) -> ss.PosingModel | ss.InterpolationModel:
    """The model with the elastic energy of a coarse mesh; handles stay exact.

    After Hildebrandt, Schulz, von Tycowicz, Polthier 2011, "Interactive surface modeling using
    modal analysis". All tets of the coarse mesh are summed by the core, as a cubature. Their
    volumes are scaled so that they add up to that of the body, which collapses make smaller.

    Raises
    ------
    ValueError
        If the material differs from tet to tet.
    """
    problem, small = model.problem, coarse.mesh
    if problem.material.core.rows != 1:
        raise ValueError("coarse_model: the material differs from tet to tet; give one for all")
    tets = np.arange(len(small.tets), dtype=np.int32)
    rows = displacement_gradients(small, _modes(model.subspace, coarse), tets)
    volumes = tet_volumes(small.vertices, small.tets)
    weights = volumes * (problem.mesh.volume / volumes.sum())
    if isinstance(model, ss.PosingModel):
        return replace(model, elastic=Cubature(tets, weights, rows, problem.material))
    shapes = _pose_shapes(model, coarse)
    corners = shapes[:, small.tets]
    return replace(model, blends=BlendedCubature(tets, weights, rows, problem.material, corners))


def coarse_full_energy(
    model: ss.PosingModel | ss.InterpolationModel, coarse: CoarseMesh
) -> FullEnergy | FullBlends:
    """The same energy, evaluated by the vertices of the coarse mesh, which its tets share.

    A gradient costs 6 k d multiply-adds for k vertices, instead of 18 for each tet and mode.
    """
    small, material = coarse.mesh, model.problem.material
    modes = _modes(model.subspace, coarse)
    share = model.problem.mesh.volume / small.volume
    if isinstance(model, ss.PosingModel):
        part = core.ElasticEnergy(small.vertices, small.tets, material.core)
        return FullEnergy([part], np.array([share]), np.zeros((1, len(modes))), modes)
    *poses, mean = _pose_shapes(model, coarse)
    parts = [core.ElasticEnergy(pose, small.tets, material.core) for pose in poses]
    origins = np.array([(mean - pose).ravel() for pose in poses])
    weights = np.full(len(poses), share / len(poses))
    return FullBlends(FullEnergy(parts, weights, origins, modes))


def _modes(subspace: ss.AffineSubspace, coarse: CoarseMesh) -> FloatArray:
    """Modes (3k, d) at the coarse mesh's vertices."""
    d = subspace.dimension
    return subspace.basis.reshape(-1, 3, d)[coarse.kept].reshape(-1, d)


def _pose_shapes(model: ss.InterpolationModel, coarse: CoarseMesh) -> FloatArray:
    """All poses and last the mean shape, (poses + 1, k, 3)."""
    mean = model.subspace.tau.reshape(1, -1, 3)
    shapes: FloatArray = np.concatenate([model.problem.poses.shapes, mean])[:, coarse.kept]
    return np.ascontiguousarray(shapes)
