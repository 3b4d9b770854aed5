"""Problems as JSON files."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from ..arguments import as_path, require_type
from ..filling.stuff_surface import stuff_surface
from ..mesh import (
    Body,
    EmbeddedSurface,
    MirrorPlane,
    ShellMesh,
    TetMesh,
    embed_file,
    file_kind,
    open_surface,
    read_tets,
)
from ..mesh.embed_surface import WHOLE_DIAGONAL
from .body_entries import Thickness, body_content, shell_in, shell_thickness
from .domain_entries import domain_content, handle_box
from .entry_checks import check_entries, check_look, entry
from .handle_entries import handles_of
from .json_entries import as_number, as_object, as_text, within
from .material_entries import material_content, material_from
from .posing_problem import PosingProblem

_KEYS = {
    "mesh",
    "surface",
    "body",
    "up",
    "mirror",
    "material",
    "stiffness",
    "domain",
    "handles",
}


def read_problem(
    path: str | Path, *, mesh: Body | None = None, repair: bool = False
) -> PosingProblem:
    """Reads a posing problem.

    Parameters
    ----------
    path : path of a JSON file
        {"mesh": path relative to the file, "surface": path of the surface that models show, see
        `read_problem_surface`, "body": {"shell": {"thickness": number, or one per triangle}}, "up":
        axis that points up in pages and pictures, "mirror": {"normal": [x, y, z], "point": [x, y,
        z]}, the plane that mirrors poses, "material", "stiffness", "domain": {"translation",
        "angle_degrees"}, "handles": [{"name", "boxes", "spheres", "vertices", "painted", "domain"},
        ...]}. Without "mesh" the surface is filled with tets in seconds, see `stuff_surface`. With
        "body" the surface is a shell, see `shell_of_file`.
        A handle is the union of its boxes [[min corner], [max corner]] (null: unbounded), spheres
        [[x, y, z], radius] and vertices. "painted" lists the surface vertices that the user chose
        for it; only the page reads them. The first handle is the fixed one; any other may have its
        own domain, whose entries replace those of the common one. A handle whose bounds are all
        zero is held at rest as well. The material is {"model": one of `MATERIALS`, its moduli by
        name or "young" and "poisson", "regions": [...]}, where values are numbers or lists with one
        per tet, or per triangle of a shell. A region has "boxes", "spheres" and "vertices", or
        "tets", and new values or a "factor"; later regions override earlier ones. Without
        "material" the default material is used. Without "stiffness" the stiffness of the handles
        follows from the body, see `usual_stiffness`.
    mesh : TetMesh or ShellMesh, optional
        Used instead of the file's mesh, or its shell.
    repair : bool, default False
        Passed to `read_tets` for the file's mesh.

    Raises
    ------
    ValueError
        For a missing file, text that is not JSON, a missing, unknown or mistyped entry, or a
        surface that `stuff_surface` cannot fill; the message names the file and the entry.
    """
    path = as_path("read_problem", path)
    content = _load(path)
    with within(path):
        cure = "give a TetMesh or ShellMesh"
        require_type("read_problem", "mesh", mesh, TetMesh | ShellMesh | None, cure)
        if mesh is None:
            mesh = _mesh(path, content, repair=repair)
        check_look(content)
        return _problem(content, mesh)


def read_problem_surface(path: str | Path, mesh: Body) -> EmbeddedSurface | None:
    """Reads the surface that a problem file names, and embeds it in the problem's mesh.

    Parameters
    ----------
    path : path of a JSON file, see `read_problem`
    mesh : TetMesh or ShellMesh
        The problem's mesh, which fills the surface, or is its shell.

    Returns
    -------
    EmbeddedSurface or None
        For `reduce`, with the file as its source; vertices without faces are left out. None if the
        problem file names no surface.

    Raises
    ------
    ValueError
        If a file cannot be read, or the surface does not belong to the mesh: a vertex is farther
        from the mesh than the mesh's diagonal.
    """
    path = as_path("read_problem_surface", path)
    content = _load(path)
    if "surface" not in content:
        return None
    with within(path):
        file = path.parent / as_text(content["surface"], "surface")
        if isinstance(mesh, ShellMesh):
            return shell_in(open_surface(file), mesh.thickness, file)[1]
        assert isinstance(mesh, TetMesh)
        return embed_file(open_surface(file).compact(), mesh, farthest=WHOLE_DIAGONAL)


def problem_content(
    problem: PosingProblem,
    mesh_path: str | None = None,
    surface_path: str | None = None,
    *,
    up: str | None = None,
    mirror: MirrorPlane | None = None,
) -> dict[str, Any]:
    """The problem as JSON content for `read_problem`, with handles as lists of vertices.

    Arguments that are None are left out.
    """
    common = problem.domain.common.bounds[0]
    content: dict[str, Any] = {
        "material": material_content(problem.material),
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
    plane = None if mirror is None else mirror.content
    given = {"mesh": mesh_path, "surface": surface_path, "up": up, "mirror": plane}
    named = {key: value for key, value in given.items() if value is not None}
    return named | body_content(problem.mesh) | content


def _load(path: Path) -> dict[str, Any]:
    try:
        content = json.loads(path.read_text(encoding="utf-8-sig"))
    except FileNotFoundError:
        raise ValueError(f"{path}: there is no such problem file") from None
    except (OSError, UnicodeDecodeError) as error:
        _check_kind(path)
        raise ValueError(f"{path}: cannot be read as a problem file ({error})") from None
    except (ValueError, RecursionError) as error:
        _check_kind(path)
        raise ValueError(f"{path}: not valid JSON: {error}") from None
    with within(path):
        return as_object(content, "a problem", known=_KEYS)


def _check_kind(path: Path) -> None:
    """ValueError, which says what the file is, unless its name ends in .json."""
    if path.is_file() and path.suffix.lower() != ".json":
        raise ValueError(
            f"{path}: this is {file_kind(path)}, but a problem (.json) is needed, which names the "
            "mesh and its handles; `snapspace view` makes one of a mesh"
        )


def problem_surface_file(path: Path) -> Path | None:
    """The surface that a problem file names in place of tets; None if it names tets.

    ValueError as for `read_problem`, and if it names neither.
    """
    content = _load(path)
    with within(path):
        return _surface_in_place_of_tets(path, content)


def check_problem(path: Path) -> None:
    """ValueError for mistakes in a problem of a solid that do not depend on its mesh.

    `read_problem` finds these and others once there is a mesh, but making one may take minutes.
    """
    with within(path):
        check_entries(_load(path))


def problem_thickness(path: Path) -> Thickness | None:
    """The thickness of the shell that a problem file describes; None for a solid.

    ValueError as for `read_problem`.
    """
    with within(path):
        return shell_thickness(_load(path))


def _surface_in_place_of_tets(path: Path, content: dict[str, Any]) -> Path | None:
    if "mesh" in content:
        return None
    if "surface" not in content:
        raise ValueError("the entries 'mesh' and 'surface' are missing; one is needed")
    return path.parent / as_text(content["surface"], "surface")


def _mesh(path: Path, content: dict[str, Any], *, repair: bool) -> Body:
    thickness = shell_thickness(content)
    surface = _surface_in_place_of_tets(path, content)
    if surface is not None and thickness is not None:
        return shell_in(open_surface(surface), thickness, surface)[0]
    if surface is not None:
        check_entries(content)
        file = open_surface(surface).compact()
        with within(surface):
            return stuff_surface(file.vertices, file.faces, mend=True)
    return read_tets(path.parent / as_text(entry(content, "mesh"), "mesh"), repair=repair)


def _problem(content: dict[str, Any], mesh: Body) -> PosingProblem:
    return PosingProblem(
        mesh,
        handles_of(entry(content, "handles"), mesh),
        material=material_from(content.get("material", {}), mesh),
        stiffness=as_number(content["stiffness"], "stiffness") if "stiffness" in content else None,
        domain=handle_box(entry(content, "domain"), content["handles"]),
    )
