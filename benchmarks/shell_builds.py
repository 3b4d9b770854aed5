"""Default builds of posed shells: seconds, and errors of unseen motions.

    python benchmarks/shell_builds.py
    python benchmarks/shell_builds.py --surface cloth --thickness 0.01 --json
    python benchmarks/shell_builds.py --hinges   # neo-Hookean, with hinges

The lowest and the highest 3 % of the vertices (y) are handles; the highest move by up to 30 degrees
and a tenth of the diagonal. *First* is the first model that `growing_models` and the page show.
`cloth` is generated and open; the others come from the folder of meshes. Errors are those of
motions that the build has not seen, against tight full solutions. *Lower* is how many of these were
replaced by solutions of lower energy, which frames of the last model lead to.
"""

from __future__ import annotations

import argparse
import json
import time
from typing import Any

import cloth
import common
import numpy as np
import shells

import snapspace as ss
from snapspace.validation import with_lower_minima

SURFACES = {"spot": "spot_11k.obj", "armadillo": "armadillo_15k.obj", "cloth": None}
#: Share of the vertices in each handle.
HELD = 0.03
CLOTH_TRIANGLES = 20_000


def shell(name: str, thickness: float) -> ss.ShellMesh:
    """A surface as a shell, its thickness a share of the diagonal."""
    path = SURFACES[name]
    return shells.read_shell(path, thickness) if path else cloth.cloth(CLOTH_TRIANGLES, thickness)


def posed(mesh: ss.ShellMesh, material: ss.Material | None) -> ss.PosingProblem:
    """The shell with its lowest and highest vertices as handles."""
    height = mesh.vertices[:, 1]
    ends = [height < np.quantile(height, HELD), height > np.quantile(height, 1 - HELD)]
    domain = ss.HandleBox(translation=0.1 * mesh.diagonal, angle=np.pi / 6)
    handles = ss.Handles(ends, names=["low", "high"])
    return ss.PosingProblem(mesh, handles, domain=domain, material=material)


def figures(name: str, args: argparse.Namespace) -> dict[str, Any]:
    """Figures of one surface."""
    material = ss.StableNeoHookean() if args.hinges else None
    problem = posed(shell(name, args.thickness), material)
    begin = time.perf_counter()
    first = None
    for growth in ss.growing_models(problem):
        first = first or growth
        last = growth
    seconds = time.perf_counter() - begin
    reference, lower = with_lower_minima(last.model, common.references(problem, args.motions))
    errors, rough = (common.reduced_errors(growth.model, reference) for growth in (last, first))
    return {
        "surface": name,
        "triangles": len(problem.mesh.cells),
        "samples": len(last.snapshots),
        "d": last.model.dimension,
        "median": float(np.median(errors)),
        "mean": float(errors.mean()),
        "lower": lower,
        "first s": first.seconds,
        "first median": float(np.median(rough)),
        "s": seconds,
    }


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--surface", choices=SURFACES, action="append", help="default: all")
    parser.add_argument("--thickness", type=float, default=0.01, help="share of the diagonal")
    parser.add_argument("--hinges", action="store_true", help="hinges instead of ARAP")
    parser.add_argument("--motions", type=int, default=15, help="number of unseen motions")
    parser.add_argument("--json", action="store_true")
    args = parser.parse_args()
    found = [figures(name, args) for name in args.surface or SURFACES]
    if args.json:
        print(json.dumps(found))
    else:
        common.print_rows(found, title="default builds of shells", width=140)


if __name__ == "__main__":
    main()
