"""Problems as JSON files."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..energy import StVK
from ..mesh import EmbeddedSurface, TetMesh, compact_surface, embed_surface, read_surface, read_tets
from ..mesh.embed_surface import WHOLE_DIAGONAL
from .domain_entries import domain_content, handle_box
from .handles import Handles
from .json_entries import as_index, as_list, as_number, as_object, as_text, as_three
from .posing_problem import PosingProblem
from .region import in_box, in_sphere

_KEYS = {"mesh", "surface", "material", "stiffness", "domain", "handles"}
_Mask = NDArray[np.bool_]


def read_problem(
    path: str | Path, *, mesh: TetMesh | None = None, repair: bool = False
) -> PosingProblem:
    """Reads a posing problem.

    Parameters
    ----------
    path : path of a JSON file
        {"mesh": path relative to the file, "surface": path of the surface that models show, see
        `read_problem_surface`, "material": {"model": "stvk", "lam", "mu"}, "stiffness",
        "domain": {"translation", "angle_degrees"}, "handles": [{"name", "boxes", "spheres",
        "vertices", "domain"}, ...]}. A handle is the union of its boxes [[min corner], [max
        corner]] (null: unbounded), spheres [[x, y, z], radius] and vertices. The first handle is
        the fixed one; any other may have a domain of its own, whose entries replace those of the
        common one. Where all of them are zero it is held at rest too.
    mesh : TetMesh, optional
        Used instead of the file's mesh.
    repair : bool, default False
        Passed to `read_tets` for the file's mesh.

    Raises
    ------
    ValueError
        For a missing file, text that is not JSON, a missing, unknown or mistyped entry; the
        message names the file and the entry.
    """
    path = Path(path)
    content = _load(path)
    try:
        if mesh is None:
            mesh = _mesh(path, content, repair=repair)
        return _problem(content, mesh)
    except ValueError as error:
        message = str(error)
        raise ValueError(message if str(path) in message else f"{path}: {message}") from None


def read_problem_surface(path: str | Path, mesh: TetMesh) -> EmbeddedSurface | None:
    """Reads the surface that a problem file names, and embeds it in the problem's mesh.

    Parameters
    ----------
    path : path of a JSON file, see `read_problem`
    mesh : TetMesh
        That of the problem, filled into the surface.

    Returns
    -------
    EmbeddedSurface or None
        For `reduce`; vertices without faces are left out. None if the file names no surface.

    Raises
    ------
    ValueError
        If a file cannot be read, or the surface is not that of the mesh: farther from it than its
        diagonal.
    """
    path = Path(path)
    content = _load(path)
    if "surface" not in content:
        return None
    try:
        file = path.parent / as_text(content["surface"], "surface")
        vertices, faces = compact_surface(*read_surface(file))
        return embed_surface(vertices, faces, mesh, farthest=WHOLE_DIAGONAL)
    except ValueError as error:
        message = str(error)
        raise ValueError(message if str(path) in message else f"{path}: {message}") from None


def problem_content(
    problem: PosingProblem, mesh_path: str | None = None, surface_path: str | None = None
) -> dict[str, Any]:
    """The problem as the JSON content that `read_problem` takes, handles by vertices."""
    common = problem.domain.common.bounds[0]
    content: dict[str, Any] = {
        "material": {"model": "stvk", "lam": problem.material.lam, "mu": problem.material.mu},
        "stiffness": problem.stiffness,
        "domain": domain_content(common),
        "handles": [
            {"name": handle.name, "vertices": handle.vertices.tolist()}
            for handle in problem.handles
        ],
    }
    for handle, bounds in zip(content["handles"][1:], problem.domain.bounds, strict=True):
        if (bounds != common).any():
            handle["domain"] = domain_content(bounds)
    files = {"mesh": mesh_path, "surface": surface_path}
    return {key: file for key, file in files.items() if file is not None} | content


def _load(path: Path) -> dict[str, Any]:
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        raise ValueError(f"{path}: there is no such problem file") from None
    except (OSError, UnicodeDecodeError) as error:
        raise ValueError(f"{path}: cannot be read as a problem file ({error})") from None
    except (ValueError, RecursionError) as error:
        raise ValueError(f"{path}: not valid JSON: {error}") from None
    return as_object(content, f"{path}: a problem", known=_KEYS)


def _entry(content: dict[str, Any], key: str) -> Any:
    if key not in content:
        raise ValueError(f"the entry '{key}' is missing")
    return content[key]


def _mesh(path: Path, content: dict[str, Any], *, repair: bool) -> TetMesh:
    return read_tets(path.parent / as_text(_entry(content, "mesh"), "mesh"), repair=repair)


def _problem(content: dict[str, Any], mesh: TetMesh) -> PosingProblem:
    return PosingProblem(
        mesh,
        _handles(_entry(content, "handles"), mesh),
        material=_material(content.get("material", {})),
        stiffness=as_number(_entry(content, "stiffness"), "stiffness"),
        domain=handle_box(_entry(content, "domain"), content["handles"]),
    )


def _material(value: Any) -> StVK:
    content = as_object(value, "material", known={"model", "lam", "mu"})
    model = content.get("model", "stvk")
    if model != "stvk":
        raise ValueError(f"material: unknown model '{model}'; known is stvk")
    return StVK(
        lam=as_number(content.get("lam", 1.0), "material.lam"),
        mu=as_number(content.get("mu", 1.0), "material.mu"),
    )


def _handles(value: Any, mesh: TetMesh) -> Handles:
    known = {"name", "boxes", "spheres", "vertices", "domain"}
    items = [
        as_object(item, f"handles[{i}]", known=known)
        for i, item in enumerate(as_list(value, "handles"))
    ]
    names = [
        as_text(item.get("name", f"handle_{i}"), f"handles[{i}].name")
        for i, item in enumerate(items)
    ]
    masks = [_mask(item, name, mesh) for item, name in zip(items, names, strict=True)]
    return Handles(masks, names=names)


def _mask(item: dict[str, Any], name: str, mesh: TetMesh) -> _Mask:
    """The union of a handle's boxes, spheres and vertices."""
    where = f"handle '{name}'"
    mask = np.zeros(len(mesh.vertices), dtype=np.bool_)
    try:
        for box in as_list(item.get("boxes", []), "boxes"):
            mask |= _in_box(box, mesh)
        for sphere in as_list(item.get("spheres", []), "spheres"):
            center, radius = as_list(sphere, "a sphere", items=("center", "radius"))
            center, radius = as_three(center, "a center"), as_number(radius, "a radius")
            mask |= in_sphere(mesh.vertices, center, radius)
        for vertex in as_list(item.get("vertices", []), "vertices"):
            mask[as_index(vertex, "a vertex", below=len(mask))] = True
    except ValueError as error:
        raise ValueError(f"{where}: {error}") from None
    return mask


def _in_box(box: Any, mesh: TetMesh) -> _Mask:
    lower, upper = (
        [
            None if bound is None else as_number(bound, "a corner")
            for bound in as_list(corner, "a corner")
        ]
        for corner in as_list(box, "a box", items=("min corner", "max corner"))
    )
    return in_box(mesh.vertices, lower, upper)
