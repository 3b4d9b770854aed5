"""Packing: the part of a model that the page needs, small enough to be embedded in it."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..arguments import require_type
from ..disk.safetensors_bytes import safetensors_bytes
from ..mesh import EmbeddedSurface
from ..model_file.appearance import appearance_arrays
from ..model_file.container import Arrays
from ..model_file.local_rows import local_arrays
from ..model_file.model_file import PACKED_FORMAT
from ..reduction import (
    BlendedCubature,
    BlendedStars,
    BlendedSum,
    Cubature,
    FullBlends,
    FullEnergy,
    InterpolationModel,
    PoseQuartics,
    PosingModel,
    Quartic,
    ReducedModel,
    not_stored,
)
from ..subspace import RigidFrames
from .estimator import estimator_arrays
from .mirror import mirror_about
from .painted import handle_of_vertex
from .shape_space import quantised

#: Since version 2 the page supports any material, by name.
VERSION = 2
AXES = ("x", "y", "z")

FloatArray = NDArray[np.float64]


def packed(
    model: ReducedModel,
    *,
    name: str,
    up: str | None = None,
    before: PosingModel | None = None,
    owners: NDArray[np.int32] | None = None,
    mirror: dict[str, Any] | None = None,
) -> bytes:
    """The model as the page reads it.

    It has the surface only, with the materials of its file, modes as 16-bit integers and
    coefficients in single precision.

    Parameters
    ----------
    model : PosingModel or InterpolationModel
    name : str
        Title on the page.
    up : "x", "y" or "z", default the model's own
        Axis that points up at first.
    before : PosingModel, optional
        An earlier model of the same body and handles, whose shapes are carried over to this one.
    owners : ndarray of int, (s,), optional
        For a posing model, the handle of each surface vertex, -1 for none. Default: that of
        `handle_of_vertex`.
    mirror : dict, optional
        How the page mirrors poses of a posing model. Default: `mirror_about`.

    Returns
    -------
    bytes
        A safetensors layout; the same model and name give the same bytes. Shapes of the surface
        differ from the model's by about 1e-5 of the displacement.

    Raises
    ------
    TypeError
        For a model of an unknown type.
    ValueError
        For an unknown axis, or a title that is not a string.
    """
    require_type("packed", "the title", name, str, "give a string")
    if up is None:
        up = getattr(model, "up", "z")
    if up not in AXES:
        raise ValueError(f"packed: up is '{up}', but it must be one of {', '.join(AXES)}")
    if isinstance(model, PosingModel):
        kind, arrays, about = "posing", _posing_arrays(model), _posing_metadata(model)
        about["mirror"] = mirror_about(model) if mirror is None else mirror
        if owners is not None:
            arrays["handle_of_vertex"] = owners.astype(np.int32)
        if before is not None:
            arrays["from_before"] = _modes_in_other(before, model)
    elif isinstance(model, InterpolationModel):
        kind, arrays = "interpolation", _interpolation_arrays(model)
        about = {
            "poses": list(model.problem.poses.names),
            "lowest_weight": model.problem.domain.lowest,
        }
    else:
        raise TypeError(f"packed: the page cannot show a {type(model).__name__}")
    look, about["appearance"] = appearance_arrays(model.surface)
    about |= {
        "name": name,
        "up": up,
        "diagonal": model.problem.mesh.diagonal,
        "value_scale": model.value_scale,
        "coordinate_scale": model.coordinate_scale,
        "material": {"model": _density(model)},
    }
    if "timeline" in model.provenance:  # the page saved it with the model
        about["timeline"] = model.provenance["timeline"]
    header = {
        "format": PACKED_FORMAT,
        "version": str(VERSION),
        "kind": kind,
        "about": json.dumps(about, sort_keys=True),
    }
    return safetensors_bytes(arrays | look | estimator_arrays(model), header)


def _density(model: ReducedModel) -> str:
    """The name of the density of the cubature's elements, or of the body without a cubature."""
    of = model.problem if model.cubature is None else model.cubature
    return of.material.kind


def packed_name(content: bytes) -> str:
    """The name in the content of `packed`."""
    size = int.from_bytes(content[:8], "little")  # of the safetensors header
    about = json.loads(content[8 : 8 + size])["__metadata__"]["about"]
    return str(json.loads(about)["name"])


def _modes_in_other(before: PosingModel, model: PosingModel) -> NDArray[np.float32]:
    """The d' modes of one model in those of another, (d, d'): the closest ones in the M-norm."""
    subspace = model.subspace
    coordinates = subspace.coordinates(before.subspace.basis.T + subspace.tau)  # (d', d)
    return np.ascontiguousarray(coordinates.T, np.float32)


def _posing_metadata(model: PosingModel) -> dict[str, Any]:
    problem = model.problem
    bounds = np.vstack([np.zeros(6), problem.domain.bounds]).tolist()
    return {
        "handles": [
            {"name": name, "center": center}
            for name, center in zip(problem.handles.names, problem.centroids.tolist(), strict=True)
        ],
        "boxes": [{"translation": row[:3], "angle": row[3:]} for row in bounds],
    }


def _posing_arrays(model: PosingModel) -> Arrays:
    surface = model.surface
    return {
        "base": _on_surface(surface, model.subspace.tau[None])[0].astype(np.float32),
        "faces": surface.faces,
        "handle_of_vertex": handle_of_vertex(model),
        **_modes("space", _on_surface(surface, model.subspace.basis.T)),
        **_elastic_arrays(model.elastic),
        "handle_K": _quadratic_part(model),
        "handle_L": model.handles.L,
        "handle_S": model.handles.S,
        **_frame_arrays(model),
    }


def _quadratic_part(model: PosingModel) -> FloatArray:
    """K of the handles, plus the elastic energy that is not in a cubature's elements."""
    elastic, K = model.elastic, model.handles.K
    left = elastic.remainder if isinstance(elastic, Cubature) else None
    return K if left is None else K + left


def _frame_arrays(model: PosingModel) -> Arrays:
    """The products that a step in time needs when the first handle moves."""
    frames = RigidFrames(model.subspace)
    return {
        "frame_modes": frames.modes.astype(np.float32),
        "frame_tau": frames.tau,
        "frame_ones": frames.ones,
    }


def _elastic_arrays(elastic: Quartic | Cubature | FullEnergy) -> Arrays:
    if isinstance(elastic, FullEnergy):
        raise not_stored("packed")
    if isinstance(elastic, Cubature):
        return {
            **_row_arrays(elastic),
            "cubature_weights": elastic.weights,
            "cubature_moduli": elastic.material.moduli,
        }
    return {"quartic": elastic.coefficients.astype(np.float32)}


def _row_arrays(energy: Cubature | BlendedCubature) -> Arrays:
    """Rows of all coordinates, or their factors, cluster by cluster."""
    return local_arrays(energy) or {"cubature_rows": energy.rows}


def _interpolation_arrays(model: InterpolationModel) -> Arrays:
    problem, surface, tau = model.problem, model.surface, model.subspace.tau
    return {
        "base": _on_surface(surface, tau[None])[0].astype(np.float32),
        "faces": surface.faces,
        **_modes("space", _on_surface(surface, model.subspace.basis.T)),
        **_modes("poses", _on_surface(surface, problem.pose_shapes - tau)),
        **_blend_arrays(model.blends),
        "sample_weights": model.training_parameters.astype(np.float32),
        "sample_coordinates": model.training_coordinates.astype(np.float32),
    }


def _blend_arrays(blends: PoseQuartics | BlendedSum | FullBlends) -> Arrays:
    if isinstance(blends, FullBlends):
        raise not_stored("packed")
    if isinstance(blends, BlendedStars):
        return {
            "stars_rows": blends.rows,
            "stars_weights": blends.weights,
            "stars_moduli": blends.material.moduli,
            "stars_origins": blends.origins,
            "stars_forms": blends.forms,
            "stars_dirichlet": blends.dirichlet_forms,
        }
    if isinstance(blends, BlendedSum):
        return {
            **_row_arrays(blends),
            "cubature_weights": blends.weights,
            "cubature_moduli": blends.material.moduli,
            "cubature_corners": blends.corners.reshape(*blends.corners.shape[:2], 12),
        }
    return {"quartics": blends.coefficients.astype(np.float32)}


def _on_surface(surface: EmbeddedSurface, rows: FloatArray) -> FloatArray:
    """Values (3n,) of each row at the vertices of the surface, (k, 3s)."""
    return np.array([surface.vertices(row).reshape(-1) for row in rows])


def _modes(name: str, rows: FloatArray) -> Arrays:
    integers, scales = quantised(rows)
    return {f"{name}_modes": integers, f"{name}_scales": scales}
