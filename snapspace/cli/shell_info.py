"""Numbers about shells, for `info`."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..mesh import ShellMesh


def shell_figures(mesh: ShellMesh) -> dict[str, Any]:
    """Sizes of a shell, for JSON."""
    return {
        "vertices": len(mesh.vertices),
        "triangles": len(mesh.triangles),
        "hinges": len(mesh.hinges),
        "boundary_edges": 3 * len(mesh.triangles) - 2 * len(mesh.hinges),
        "components": int(mesh.components.max()) + 1,
        "area": float(mesh.areas.sum()),
        "thickness": {"min": float(np.min(mesh.thickness)), "max": float(np.max(mesh.thickness))},
        "volume": mesh.volume,
        "diagonal": mesh.diagonal,
        "bounds": [mesh.vertices.min(axis=0).tolist(), mesh.vertices.max(axis=0).tolist()],
        "fingerprint": mesh.fingerprint,
    }


def shell_facts(figures: dict[str, Any]) -> list[tuple[str, str]]:
    """The same as lines for the user."""
    thin, thick = figures["thickness"]["min"], figures["thickness"]["max"]
    share = thick / figures["diagonal"]
    thickness = f"{thin:.4g}" if thin == thick else f"{thin:.4g} to {thick:.4g}"
    return [
        ("vertices", str(figures["vertices"])),
        ("triangles", f"{figures['triangles']}, {figures['boundary_edges']} edges at a boundary"),
        ("components", str(figures["components"])),
        ("thickness", f"{thickness}, {share:.2g} of the diagonal"),
        ("area", f"{figures['area']:.6g}"),
        ("diagonal", f"{figures['diagonal']:.6g}"),
    ]
