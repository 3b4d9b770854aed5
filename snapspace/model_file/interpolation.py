"""Interpolation models as arrays and content."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..problem import InterpolationProblem, Poses, ShellPoses
from ..reduction import (
    BlendedCubature,
    BlendedStars,
    BlendedSum,
    FullBlends,
    InterpolationModel,
    PoseQuartics,
    coefficient_count,
    not_stored,
)
from ..subspace import AffineSubspace
from . import basis, cells, local_rows, shown_surface, snapshot_energies, star_forms
from . import material as material_file
from .container import Arrays, Types, check_shapes

_COMMON: dict[str, Types] = {
    "poses": np.float64,
    "mean_shape": np.float64,
    **shown_surface.DTYPES,
    "basis": basis.DTYPES,
    "training_parameters": np.float64,
    "training_coordinates": np.float64,
}
#: A few tets instead of the quartics; their rows are computed from the basis on loading.
_CUBATURE: dict[str, Types] = {"cubature_tets": np.int32, "cubature_weights": np.float64}
DTYPES = {**_COMMON, **cells.TETS, "quartics": np.float64}
CUBATURE_DTYPES = {**_COMMON, **cells.TETS, **_CUBATURE}
SHELL_DTYPES = {**_COMMON, **cells.SHELL, **_CUBATURE}


def interpolation_arrays(model: InterpolationModel) -> Arrays:
    """The arrays of a model; the names are those of DTYPES, CUBATURE_DTYPES or SHELL_DTYPES."""
    problem = model.problem
    return {
        "poses": problem.poses.shapes,
        **cells.cell_arrays(problem.mesh),
        "mean_shape": model.subspace.tau,
        **shown_surface.surface_arrays(model.surface),
        "basis": basis.stored_basis(model.subspace),
        **snapshot_energies.energy_arrays(model.subspace),
        **material_file.material_arrays(problem.material),
        **_blend_arrays(model.blends, problem),
        "training_parameters": model.training_parameters,
        "training_coordinates": model.training_coordinates,
    }


def interpolation_content(model: InterpolationModel) -> dict[str, Any]:
    """All entries of the problem that are not arrays, as JSON."""
    problem = model.problem
    return {
        "material": material_file.material_content(problem.material),
        "extrapolation": problem.domain.extrapolation,
        "poses": list(problem.poses.names),
        "accept_inverted": bool(problem.poses.inverted_tets.any()),
        "lumped_mass": model.subspace.lumped,
        **shown_surface.surface_content(model.surface),
    }


def interpolation_model(
    arrays: Arrays, content: dict[str, Any], provenance: dict[str, Any]
) -> InterpolationModel:
    """The model of arrays and content; KeyError, TypeError or ValueError if they do not match."""
    poses = _poses(arrays, content)
    problem = InterpolationProblem(
        poses,
        material=material_file.material(arrays, content["material"], len(poses.reference.cells)),
        extrapolation=content["extrapolation"],
        mean_shape=arrays["mean_shape"],
    )
    n = len(problem.mesh.vertices)
    d, k = len(arrays["basis"]), len(arrays["training_parameters"])
    check_shapes(
        arrays,
        {
            "mean_shape": (3 * n,),
            "basis": (d, 3 * n),
            "training_parameters": (k, problem.parameter_count),
            "training_coordinates": (k, d),
        },
    )
    mass = problem.mass(lumped=content["lumped_mass"])
    modes = basis.read_basis(arrays["basis"])
    subspace = AffineSubspace(problem.tau, modes, mass, arrays.get("eigenvalues"))
    return InterpolationModel(
        problem=problem,
        subspace=subspace,
        blends=_blends(arrays, problem, subspace),
        surface=shown_surface.surface(arrays, content, problem.mesh),
        training_parameters=arrays["training_parameters"],
        training_coordinates=arrays["training_coordinates"],
        provenance=provenance,
    )


def _poses(arrays: Arrays, content: dict[str, Any]) -> Poses | ShellPoses:
    if "triangles" in arrays:
        return ShellPoses(
            arrays["poses"],
            arrays["triangles"],
            thickness=cells.thickness(arrays),
            names=content["poses"],
        )
    return Poses(
        arrays["poses"],
        arrays["tets"],
        names=content["poses"],
        accept_inverted=content["accept_inverted"],
    )


def _blend_arrays(
    blends: PoseQuartics | BlendedSum | FullBlends, problem: InterpolationProblem
) -> Arrays:
    if isinstance(blends, FullBlends):
        raise not_stored("save_model")
    if isinstance(blends, BlendedSum):
        chosen: Arrays = {"cubature_tets": blends.tets, "cubature_weights": blends.weights}
        return chosen | local_rows.local_arrays(blends) | star_forms.form_arrays(blends, problem)
    return {"quartics": blends.coefficients}


def _blends(
    arrays: Arrays, problem: InterpolationProblem, subspace: AffineSubspace
) -> PoseQuartics | BlendedSum:
    d = subspace.dimension
    if "quartics" in arrays:
        check_shapes(arrays, {"quartics": (len(problem.poses), coefficient_count(d))})
        return PoseQuartics(d, arrays["quartics"])
    tets, weights = arrays["cubature_tets"], arrays["cubature_weights"]
    check_shapes(arrays, {"cubature_tets": (tets.size,), "cubature_weights": (tets.size,)})
    stars = problem.pose_energies.stars
    if stars is not None:
        count, forms = len(problem.poses), arrays[star_forms.FORMS]
        shapes = {star_forms.FORMS: (count, d + 1, d + 1), star_forms.DIRICHLET: (count, d, d)}
        check_shapes(arrays, shapes)
        star_forms.check_stars(arrays, problem.material, stars[0], tets)
        return BlendedStars.of_tets(problem, subspace, tets, weights, forms=forms)
    rows = local_rows.local_rows(arrays, len(tets), d)
    return BlendedCubature.of_tets(problem, subspace, tets, weights, rows=rows)
