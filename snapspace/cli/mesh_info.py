"""Numbers about tet meshes and surfaces, for `info`."""

from __future__ import annotations

import warnings
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..input_error import fault_of
from ..mesh import Body, MeshNotice, ShellMesh, TetMesh, read_surface, read_tets
from ..point_text import corner_texts
from .shell_info import shell_facts, shell_figures

#: Tets with a smaller dihedral angle, in degrees, are called slivers.
SLIVER = 5

Info = tuple[dict[str, Any], list[tuple[str, str]]]


def mesh_info(file: Path) -> Info:
    """JSON content and facts of a tet mesh file; an invalid one is described as repaired.

    Raises
    ------
    ValueError
        If the file cannot be read, or has faults that cannot be repaired.
    """
    fault: str | None = None
    repairs: list[str] = []
    try:
        mesh = read_tets(file)
    except ValueError as error:
        fault = fault_of(error)
        mesh, repairs = _repaired(file, error)
    facts = [("valid", "yes" if fault is None else f"no: {fault}")]
    facts += [("a repair", note) for note in repairs]
    figures = {
        "kind": "tet mesh",
        "valid": fault is None,
        "fault": fault,
        "repairs": repairs,
        **mesh_figures(mesh),
    }
    return figures, facts + mesh_facts(figures)


def _repaired(file: Path, error: ValueError) -> tuple[TetMesh, list[str]]:
    with warnings.catch_warnings(record=True) as notes:
        warnings.simplefilter("always", MeshNotice)
        try:
            mesh = read_tets(file, repair=True)
        except ValueError:
            raise error from None
    return mesh, [str(note.message).removeprefix(f"{file}: ") for note in notes]


def cell_count(mesh: Body) -> dict[str, int]:
    """The number of tets or triangles, by name."""
    return {"triangles" if isinstance(mesh, ShellMesh) else "tets": len(mesh.cells)}


def mesh_figures(mesh: Body) -> dict[str, Any]:
    """Sizes and quality of a mesh, for JSON."""
    if isinstance(mesh, ShellMesh):
        return shell_figures(mesh)
    assert isinstance(mesh, TetMesh)
    angles = mesh.dihedral_angles
    smallest = angles.min(axis=1)
    return {
        "vertices": len(mesh.vertices),
        "tets": len(mesh.tets),
        "volume": mesh.volume,
        "diagonal": mesh.diagonal,
        "bounds": [mesh.vertices.min(axis=0).tolist(), mesh.vertices.max(axis=0).tolist()],
        "surface": {"vertices": len(mesh.surface_vertices), "faces": len(mesh.surface)},
        "dihedral_degrees": {
            "min": float(angles.min()),
            "max": float(angles.max()),
            "tets_below_5": int((smallest < SLIVER).sum()),
        },
        "tet_volume": {"min": float(mesh.volumes.min()), "max": float(mesh.volumes.max())},
        "fingerprint": mesh.fingerprint,
    }


def mesh_facts(figures: dict[str, Any]) -> list[tuple[str, str]]:
    """The same as lines for the user."""
    if "triangles" in figures:
        return shell_facts(figures)
    surface, angles = figures["surface"], figures["dihedral_degrees"]
    sizes, (low, high) = figures["tet_volume"], figures["bounds"]
    slivers = angles["tets_below_5"]
    return [
        ("vertices", str(figures["vertices"])),
        ("tets", str(figures["tets"])),
        ("surface", f"{surface['faces']} faces, {surface['vertices']} vertices"),
        ("volume", f"{figures['volume']:.6g}"),
        ("bounds", f"{' to '.join(corner_texts(low, high))}, diagonal {figures['diagonal']:.6g}"),
        (
            "dihedral angles",
            f"{angles['min']:.3g} to {angles['max']:.4g} degrees"
            + (f", {slivers} tets with one below {SLIVER}" if slivers else ""),
        ),
        ("tet volumes", f"{sizes['min']:.3g} to {sizes['max']:.3g}"),
    ]


def surface_info(file: Path) -> Info:
    """JSON content and facts of a triangle surface file; ValueError if it cannot be read."""
    vertices, faces = read_surface(file)
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    diagonal = float(np.linalg.norm(high - low))
    closed = _is_closed(faces)
    figures = {
        "kind": "surface",
        "vertices": len(vertices),
        "faces": len(faces),
        "closed": closed,
        "bounds": [low.tolist(), high.tolist()],
        "diagonal": diagonal,
    }
    facts = [
        ("vertices", str(len(vertices))),
        ("faces", str(len(faces))),
        ("closed", "yes" if closed else "no: an edge has no opposite, or faces disagree"),
        ("bounds", f"{' to '.join(corner_texts(low, high))}, diagonal {diagonal:.6g}"),
        (
            "note",
            "`snapspace interpolate` fills it and blends it with other poses; `build` fills it "
            "as well, or makes it a thin shell with --shell",
        ),
    ]
    return figures, facts


def _is_closed(faces: NDArray[np.int32]) -> bool:
    """Whether every directed edge occurs as often as its reverse."""
    edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]).astype(np.int64)
    stride = int(faces.max()) + 1
    ahead = np.sort(edges[:, 0] * stride + edges[:, 1])
    back = np.sort(edges[:, 1] * stride + edges[:, 0])
    return bool(np.array_equal(ahead, back))
