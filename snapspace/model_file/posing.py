"""Posing models as arrays and content."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..mesh import Body, ShellMesh, TetMesh, mass_matrix
from ..problem import HandleBox, Handles, PosingProblem
from ..reduction import (
    Cubature,
    FullEnergy,
    HandleQuadric,
    PosingModel,
    Quartic,
    coefficient_count,
    not_stored,
)
from ..subspace import AffineSubspace
from . import basis, cells, local_rows, shown_surface, snapshot_energies, star_forms
from . import material as material_file
from .container import Arrays, Types, check_shapes

_COMMON: dict[str, Types] = {
    "vertices": np.float64,
    "handle_vertices": np.int32,
    "handle_sizes": np.int32,
    "basis": basis.DTYPES,
    "handle_K": np.float64,
    "handle_L": np.float64,
    "handle_S": np.float64,
    "training_parameters": np.float64,
    "training_coordinates": np.float64,
}
#: A few tets instead of the quartic; their rows are computed from the basis on loading, unless they
#: have local coordinates.
_CUBATURE: dict[str, Types] = {"cubature_tets": np.int32, "cubature_weights": np.float64}
DTYPES = {**_COMMON, **cells.TETS, "quartic": np.float64}
CUBATURE_DTYPES = {**_COMMON, **cells.TETS, **_CUBATURE}
SHELL_DTYPES = {**_COMMON, **cells.SHELL, **_CUBATURE}


def posing_arrays(model: PosingModel) -> Arrays:
    """The arrays of a model; the names are those of DTYPES, CUBATURE_DTYPES or
    SHELL_DTYPES.

    The arrays of a surface are left out if it is the boundary of the tets.
    """
    problem = model.problem
    sizes = [len(handle.vertices) for handle in problem.handles]
    return {
        "vertices": problem.mesh.vertices,
        **cells.cell_arrays(problem.mesh),
        "handle_vertices": problem.pinned,
        "handle_sizes": np.array(sizes, np.int32),
        "basis": basis.stored_basis(model.subspace),
        **snapshot_energies.energy_arrays(model.subspace),
        **material_file.material_arrays(problem.material),
        **_elastic_arrays(model.elastic, problem),
        "handle_K": model.handles.K,
        "handle_L": model.handles.L,
        "handle_S": model.handles.S,
        "training_parameters": model.training_parameters,
        "training_coordinates": model.training_coordinates,
        **shown_surface.own_arrays(model.surface, problem.mesh),
    }


def posing_content(model: PosingModel) -> dict[str, Any]:
    """All entries of the problem that are not arrays, as JSON."""
    problem = model.problem
    domain = problem.domain
    # one row where bounds are common, as in files from before handles could have their own
    bounds = domain.bounds if domain.common is not domain else domain.bounds[0]
    return {
        "material": material_file.material_content(problem.material),
        "stiffness": problem.stiffness,
        "domain": {
            "translation": bounds[..., :3].tolist(),
            "angle": bounds[..., 3:].tolist(),
        },
        "handles": list(problem.handles.names),
        "lumped_mass": model.subspace.lumped,
        **shown_surface.surface_content(model.surface),
    }


def posing_model(
    arrays: Arrays, content: dict[str, Any], provenance: dict[str, Any]
) -> PosingModel:
    """The model of arrays and content; KeyError, TypeError or ValueError if they do not match."""
    problem = _problem(arrays, content)
    n, h = len(problem.mesh.vertices), len(problem.handles)
    d, k = len(arrays["basis"]), len(arrays["training_parameters"])
    check_shapes(
        arrays,
        {
            "basis": (d, 3 * n),
            "handle_K": (d, d),
            "handle_L": (h, d, 12),
            "handle_S": (h, 4, 4),
            "training_parameters": (k, problem.parameter_count),
            "training_coordinates": (k, d),
        },
    )
    mass = mass_matrix(problem.mesh, lumped=content["lumped_mass"])
    modes = basis.read_basis(arrays["basis"])
    subspace = AffineSubspace(problem.tau, modes, mass, arrays.get("eigenvalues"))
    return PosingModel(
        problem=problem,
        subspace=subspace,
        elastic=_elastic(arrays, problem, subspace),
        handles=HandleQuadric(arrays["handle_K"], arrays["handle_L"], arrays["handle_S"]),
        surface=shown_surface.surface(arrays, content, problem.mesh),
        training_parameters=arrays["training_parameters"],
        training_coordinates=arrays["training_coordinates"],
        provenance=provenance,
    )


def _body(arrays: Arrays) -> Body:
    if "triangles" not in arrays:
        return TetMesh(arrays["vertices"], arrays["tets"])
    return ShellMesh(arrays["vertices"], arrays["triangles"], thickness=cells.thickness(arrays))


def _elastic_arrays(elastic: Quartic | Cubature | FullEnergy, problem: PosingProblem) -> Arrays:
    if isinstance(elastic, FullEnergy):
        raise not_stored("save_model")
    if isinstance(elastic, Cubature):
        chosen: Arrays = {"cubature_tets": elastic.tets, "cubature_weights": elastic.weights}
        return (
            chosen
            | local_rows.local_arrays(elastic)
            | star_forms.remainder_arrays(elastic, problem)
        )
    return {"quartic": elastic.coefficients}


def _elastic(
    arrays: Arrays, problem: PosingProblem, subspace: AffineSubspace
) -> Quartic | Cubature:
    if "quartic" in arrays:
        check_shapes(arrays, {"quartic": (coefficient_count(subspace.dimension),)})
        return Quartic(subspace.dimension, arrays["quartic"])
    tets, weights = arrays["cubature_tets"], arrays["cubature_weights"]
    check_shapes(arrays, {"cubature_tets": (tets.size,), "cubature_weights": (tets.size,)})
    remainder = None
    if problem.energy.stars is not None:
        star_forms.check_stars(arrays, problem.material, problem.energy.stars, tets)
        remainder = arrays[star_forms.REMAINDER]
        check_shapes(arrays, {star_forms.REMAINDER: (subspace.dimension, subspace.dimension)})
    rows = local_rows.local_rows(arrays, len(tets), subspace.dimension)
    return Cubature.of_tets(problem, subspace, tets, weights, rows=rows, remainder=remainder)


def _problem(arrays: Arrays, content: dict[str, Any]) -> PosingProblem:
    ends = np.cumsum(arrays["handle_sizes"])[:-1]
    handles = Handles(np.split(arrays["handle_vertices"], ends), names=content["handles"])
    domain = content["domain"]
    mesh = _body(arrays)
    return PosingProblem(
        mesh,
        handles,
        material=material_file.material(arrays, content["material"], len(mesh.cells)),
        stiffness=content["stiffness"],
        domain=HandleBox(
            translation=np.array(domain["translation"]),
            angle=np.array(domain["angle"]),
            moving=len(handles) - 1,
        ),
    )
