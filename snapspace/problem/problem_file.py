"""Problems as JSON files."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from ..energy import StVK
from ..mesh import TetMesh, read_tets
from .handle_box import HandleBox
from .handles import Handles
from .posing_problem import PosingProblem
from .region import in_box, in_sphere

_KEYS = {"mesh", "material", "stiffness", "domain", "handles"}


def read_problem(
    path: str | Path, *, mesh: TetMesh | None = None, repair: bool = False
) -> PosingProblem:
    """Reads a posing problem.

    Parameters
    ----------
    path : path of a JSON file
        {"mesh": path relative to the file, "material": {"model": "stvk", "lam", "mu"}, "stiffness",
        "domain": {"translation", "angle_degrees"}, "handles": [{"name", "boxes", "spheres",
        "vertices"}, ...]}. A handle is the union of its boxes [[min corner], [max corner]] (null:
        unbounded), spheres [[x, y, z], radius] and vertices; the first handle is the fixed one.
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
    except (TypeError, KeyError, IndexError) as error:
        raise ValueError(f"{path}: an entry has the wrong form ({error})") from None
    except ValueError as error:
        message = str(error)
        raise ValueError(message if str(path) in message else f"{path}: {message}") from None


def problem_content(problem: PosingProblem, mesh_path: str | None = None) -> dict[str, Any]:
    """The problem as the JSON content that `read_problem` takes, handles by vertices."""
    bounds = problem.domain.half_widths[:6]
    content: dict[str, Any] = {
        "material": {"model": "stvk", "lam": problem.material.lam, "mu": problem.material.mu},
        "stiffness": problem.stiffness,
        "domain": {
            "translation": bounds[:3].tolist(),
            "angle_degrees": np.rad2deg(bounds[3:]).tolist(),
        },
        "handles": [
            {"name": handle.name, "vertices": handle.vertices.tolist()}
            for handle in problem.handles
        ],
    }
    return content if mesh_path is None else {"mesh": mesh_path, **content}


def _load(path: Path) -> dict[str, Any]:
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        raise ValueError(f"{path}: there is no such problem file") from None
    except (OSError, UnicodeDecodeError) as error:
        raise ValueError(f"{path}: cannot be read as a problem file ({error})") from None
    except json.JSONDecodeError as error:
        raise ValueError(f"{path}: not valid JSON: {error}") from None
    if not isinstance(content, dict):
        raise ValueError(f"{path}: a problem is a JSON object, got a {type(content).__name__}")
    _refuse_unknown(content, _KEYS, str(path))
    return content


def _refuse_unknown(content: Mapping[str, Any], known: set[str], where: str) -> None:
    for key in content:
        if key not in known:
            raise ValueError(
                f"{where}: unknown entry '{key}'; known are {', '.join(sorted(known))}"
            )


def _entry(content: Mapping[str, Any], key: str) -> Any:
    if key not in content:
        raise ValueError(f"the entry '{key}' is missing")
    return content[key]


def _number(value: Any, what: str) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise ValueError(f"{what} must be a number, got {value!r}")
    return float(value)


def _bounds(value: Any, what: str) -> float | tuple[float, float, float]:
    if not isinstance(value, list):
        return _number(value, what)
    if len(value) != 3:
        raise ValueError(f"{what} must be one number or three, got {len(value)}")
    x, y, z = (_number(item, what) for item in value)
    return x, y, z


def _mesh(path: Path, content: Mapping[str, Any], *, repair: bool) -> TetMesh:
    name = _entry(content, "mesh")
    if not isinstance(name, str):
        raise ValueError(f"'mesh' must be a path, got {name!r}")
    return read_tets(path.parent / name, repair=repair)


def _problem(content: Mapping[str, Any], mesh: TetMesh) -> PosingProblem:
    domain = _entry(content, "domain")
    _refuse_unknown(domain, {"translation", "angle_degrees"}, "domain")
    angle = np.deg2rad(_bounds(_entry(domain, "angle_degrees"), "domain.angle_degrees"))
    box = HandleBox(
        translation=_bounds(_entry(domain, "translation"), "domain.translation"),
        angle=float(angle) if angle.ndim == 0 else (angle[0], angle[1], angle[2]),
    )
    return PosingProblem(
        mesh,
        _handles(_entry(content, "handles"), mesh),
        material=_material(content.get("material", {})),
        stiffness=_number(_entry(content, "stiffness"), "stiffness"),
        domain=box,
    )


def _material(content: Mapping[str, Any]) -> StVK:
    _refuse_unknown(content, {"model", "lam", "mu"}, "material")
    model = content.get("model", "stvk")
    if model != "stvk":
        raise ValueError(f"material: unknown model '{model}'; known is stvk")
    return StVK(
        lam=_number(content.get("lam", 1.0), "material.lam"),
        mu=_number(content.get("mu", 1.0), "material.mu"),
    )


def _handles(content: Any, mesh: TetMesh) -> Handles:
    if not isinstance(content, list):
        raise ValueError(f"'handles' must be a list, got a {type(content).__name__}")
    names = [str(item.get("name", f"handle_{i}")) for i, item in enumerate(content)]
    masks = [_mask(item, name, mesh) for item, name in zip(content, names, strict=True)]
    return Handles(masks, names=names)


def _mask(item: Mapping[str, Any], name: str, mesh: TetMesh) -> np.ndarray[Any, np.dtype[np.bool_]]:
    where = f"handle '{name}'"
    _refuse_unknown(item, {"name", "boxes", "spheres", "vertices"}, where)
    mask = np.zeros(len(mesh.vertices), dtype=bool)
    try:
        for lower, upper in item.get("boxes", []):
            mask |= in_box(mesh.vertices, lower, upper)
        for center, radius in item.get("spheres", []):
            mask |= in_sphere(mesh.vertices, center, radius)
    except (ValueError, TypeError) as error:
        raise ValueError(f"{where}: {error}") from None
    for vertex in item.get("vertices", []):
        if isinstance(vertex, bool) or not isinstance(vertex, int):
            raise ValueError(f"{where}: a vertex must be an index, got {vertex!r}")
        if not 0 <= vertex < len(mask):
            raise ValueError(
                f"{where}: vertex index {vertex} is out of range, the mesh has {len(mask)} vertices"
            )
        mask[vertex] = True
    return mask
