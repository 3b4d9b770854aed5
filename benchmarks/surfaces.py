"""From surfaces to validated models, by one command each: seconds, and errors of surface and tets.

    python benchmarks/surfaces.py                    # quick tets
    python benchmarks/surfaces.py --exact            # fTetWild's tets, minutes per surface
    python benchmarks/surfaces.py --round-trip       # every real surface written back, moved

Handles and boxes are those of the problem files; the material is the default one.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

import common
import numpy as np

import snapspace as ss
from snapspace.mesh import SURFACE_SUFFIXES

SURFACES = {
    "spot": "spot_11k.obj",
    "dragon": "asianDragon_25k_fixed.off",
    "elephant": "elephant-50kv_fixed.off",
    "armadillo": "armadillo_15k.obj",
}


def problem_file(name: str, folder: Path) -> Path:
    """A problem with the handles and boxes of a real one, whose surface has no tets yet."""
    meshes = common.meshes_folder()
    content = json.loads((meshes / "problems" / f"{name}.json").read_text(encoding="utf-8"))
    kept = {key: content[key] for key in ("domain", "handles")}
    kept["surface"] = str(meshes / "surfaces" / SURFACES[name])
    path = folder / f"{name}.json"
    path.write_text(json.dumps(kept), encoding="utf-8")
    return path


def surface_errors(model: ss.PosingModel, reference: ss.Snapshots) -> np.ndarray:
    """Relative errors of the surface's vertices on reference motions, (m,)."""
    session, mesh, surface = model.session(), model.problem.mesh, model.surface
    rest = surface.vertices(mesh.vertices)
    errors = []
    for parameters, shape in zip(reference.parameters, reference.shapes, strict=True):
        session.reset()
        session.set_parameters(parameters)
        exact = surface.vertices(shape)
        moved = np.linalg.norm(exact - rest)
        errors.append(np.linalg.norm(surface.vertices(session.vertices) - exact) / moved)
    return np.array(errors)


def measured(name: str, folder: Path, *, exact: bool, motions: int) -> dict[str, Any]:
    """Figures of one surface."""
    path = folder / f"{name}.snapspace"
    command = [sys.executable, "-m", "snapspace", "build", "--problem", problem_file(name, folder)]
    command += ["-o", path, *(["--exact"] if exact else [])]
    begin = time.perf_counter()
    subprocess.run([*map(str, command)], check=True)
    seconds = time.perf_counter() - begin
    model = ss.load(path)
    assert isinstance(model, ss.PosingModel)
    reference = common.references(model.problem, motions)
    tets, surface = common.reduced_errors(model, reference), surface_errors(model, reference)
    return {
        "surface": name,
        "vertices": len(model.surface.corners),
        "tets": len(model.problem.mesh.tets),
        "seconds": seconds,
        "dimension": model.dimension,
        "tet error, median": float(np.median(tets)),
        "tet error, mean": float(tets.mean()),
        "surface error, median": float(np.median(surface)),
        "surface error, mean": float(surface.mean()),
    }


def round_trip(file: Path) -> dict[str, Any]:
    """Whether a file is written back byte by byte, and what differs if it is moved."""
    surface = ss.open_surface(file)
    same = surface.with_vertices(surface.vertices) == surface.data
    begin = time.perf_counter()
    moved = surface.with_vertices(1.5 * surface.vertices)
    seconds = time.perf_counter() - begin
    before, after = surface.data.splitlines(), moved.splitlines()
    again = ss.SurfaceFile(file.name, moved)
    scale = np.abs(surface.vertices).max()
    return {
        "file": file.name,
        "bytes": len(surface.data),
        "unmoved, same bytes": same,
        "lines": len(before),
        "lines that changed": sum(a != b for a, b in zip(before, after, strict=True)),
        "vertices": len(surface.vertices),
        "largest error": float(np.abs(again.vertices - 1.5 * surface.vertices).max() / scale),
        "seconds": seconds,
    }


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--surface", choices=SURFACES, action="append", help="default: all")
    parser.add_argument("--exact", action="store_true")
    parser.add_argument("--motions", type=int, default=15)
    parser.add_argument("--round-trip", action="store_true")
    parser.add_argument("--json", action="store_true")
    args = parser.parse_args()
    if args.round_trip:
        files = sorted(
            path
            for path in common.meshes_folder().rglob("*")
            if path.suffix.lower() in SURFACE_SUFFIXES
        )
        rows = [round_trip(file) for file in files]
    else:
        with tempfile.TemporaryDirectory() as folder:
            rows = [
                measured(name, Path(folder), exact=args.exact, motions=args.motions)
                for name in args.surface or SURFACES
            ]
    if args.json:
        print(json.dumps(rows))
    else:
        common.print_rows(rows, title="surfaces", width=200)


if __name__ == "__main__":
    main()
