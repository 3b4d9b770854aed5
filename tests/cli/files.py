"""Files of a small bar for the commands: a mesh, a problem, and altered copies of them."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from snapspace import TetMesh, write_tets
from snapspace.generators import bar


def bar_mesh(nx: int = 8, ny: int = 2, nz: int = 2) -> TetMesh:
    return bar(nx, ny, nz)


def problem_content(**changes: Any) -> dict[str, Any]:
    """A bar of length 4 that is fixed at its left end and moved at its right one."""
    left = {"name": "left", "boxes": [[[None, None, None], [0.01, None, None]]]}
    right = {"name": "right", "boxes": [[[3.99, None, None], [None, None, None]]]}
    content = {
        "mesh": "bar.msh",
        "material": {"model": "stvk", "lam": 1.0, "mu": 1.0},
        "stiffness": 1000,
        "domain": {"translation": 0.5, "angle_degrees": 30},
        "handles": [left, right],
    }
    return {**content, **changes}


def write_problem(folder: Path, name: str = "bar.json", **changes: Any) -> Path:
    """The problem file; the mesh is written beside it if it is not there."""
    if not (folder / "bar.msh").exists():
        write_tets(folder / "bar.msh", bar_mesh())
    path = folder / name
    path.write_text(json.dumps(problem_content(**changes)), encoding="utf-8")
    return path


def write_raw(path: Path, vertices: NDArray[np.float64], tets: NDArray[np.int32]) -> None:
    """A MEDIT file without any check."""
    rows = [f"{x!r} {y!r} {z!r} 0" for x, y, z in vertices.tolist()]
    cells = [" ".join(str(i + 1) for i in tet) + " 0" for tet in tets.tolist()]
    head = ["MeshVersionFormatted 2", "Dimension 3"]
    lines = [*head, f"Vertices {len(rows)}", *rows, f"Tetrahedra {len(cells)}", *cells, "End"]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def contents(folder: Path) -> dict[str, bytes]:
    """All files below a folder, to see that none was touched."""
    return {
        str(path.relative_to(folder)): path.read_bytes()
        for path in sorted(folder.rglob("*"))
        if path.is_file()
    }
