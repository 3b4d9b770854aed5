"""Shape interpolation on real poses: seconds per stage, errors, ms per frame, and fits.

python benchmarks/interpolation.py --set helix
python benchmarks/interpolation.py --set centaur
python benchmarks/interpolation.py --set lion --poses lion-06
"""

from __future__ import annotations

import argparse
import sys
import time
from dataclasses import dataclass

import common
import numpy as np

import snapspace as ss
from snapspace.fitting import fit_poses


@dataclass(frozen=True)
class Set:
    """Poses of the meshes' folder, and the target figures."""

    reference: str
    poses: tuple[str, ...]
    tets: str | None
    samples: int
    dimension: int
    sampling: str
    goal: float
    paper: str


SETS = {
    "helix": Set(
        "poses/synthetic_helix/cylinder.mesh",
        ("helix",),
        None,
        30,
        20,
        "grid",
        3.0,
        "paper: 27 s + 5.9 s, 1.8 ms a frame, error 0.002",
    ),
    "lion": Set(
        "poses/sumner_lion/lion-reference_fixed.off",
        ("lion-06",),
        "tets/sumner_lion_Yq1.4a.mesh",
        4,
        6,
        "grid",
        5.0,
        "paper: 26 s + 1.2 s, 0.4 ms a frame",
    ),
    "dog": Set(
        "poses/tosca_dog/dog0.off",
        ("dog1", "dog2"),
        "tets/tosca_dog_Yq2.mesh",
        20,
        10,
        "sobol",
        40.0,
        "paper: 477 s + 25 s, 1.8 ms a frame",
    ),
    "centaur": Set(
        "poses/tosca_centaur/centaur0_fixed.off",
        tuple(f"centaur{k}" for k in range(1, 6)),
        "tets/tosca_centaur_Yq2.mesh",
        40,
        24,
        "sobol",
        60.0,
        "paper: 561 s + 726 s, 7 ms a frame",
    ),
}


def read_poses(chosen: Set, names: tuple[str, ...]) -> tuple[ss.Poses, list[object], float]:
    """The poses, the reports of the fits, and the seconds of fitting."""
    folder = common.meshes_folder()
    reference = folder / chosen.reference
    if not reference.is_file():
        sys.exit(f"{reference} is missing: set SNAPSPACE_MESHES")
    files = [reference.with_name(f"{name}{reference.suffix}") for name in names]
    labels = [reference.stem, *names]
    if chosen.tets is None:
        meshes = [ss.read_tets(file) for file in (reference, *files)]
        return ss.Poses.of(meshes, names=labels), [], 0.0
    mesh = ss.read_tets(folder / chosen.tets)
    surface = ss.embed_surface(*ss.read_surface(reference), mesh)
    targets = np.stack([ss.read_surface(file)[0] for file in files])
    begin = time.perf_counter()
    fits = fit_poses(mesh, surface, targets, names=names)
    seconds = time.perf_counter() - begin
    shapes = np.concatenate([mesh.vertices[None], fits.shapes])
    return ss.Poses(shapes, mesh.tets, names=labels), list(fits.reports), seconds


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--set", default="helix", choices=SETS)
    parser.add_argument("--poses", help="other poses, by name, separated by commas")
    parser.add_argument("--material", default="stvk", help="default: that of the paper, stvk")
    parser.add_argument("--validate", type=int, default=20, help="number of held-out samples")
    parser.add_argument("--json", action="store_true")
    args = parser.parse_args()
    chosen = SETS[args.set]
    names = tuple(args.poses.split(",")) if args.poses else chosen.poses
    poses, fits, fitting = read_poses(chosen, names)

    laps = [time.perf_counter()]
    problem = ss.InterpolationProblem(poses, material=ss.MATERIALS[args.material]())
    _ = problem.mean_shape
    laps.append(time.perf_counter())
    parameters = ss.sample(problem.domain, chosen.samples, method=chosen.sampling)
    snapshots = ss.solve_snapshots(problem, parameters, progress=common.progress)
    laps.append(time.perf_counter())
    subspace = ss.snapshot_pca(snapshots, dimension=chosen.dimension)
    model = ss.reduce(problem, subspace, snapshots=snapshots)
    laps.append(time.perf_counter())
    solve, frame = common.drag(model, frames=600, seed=9)
    validation = ss.validate(model, samples=args.validate, progress=common.progress)

    stages, total = np.diff(laps), laps[-1] - laps[0]
    errors = validation.as_json(model.dimension)
    result = {
        "set": args.set,
        "poses": list(poses.names),
        "vertices": len(problem.mesh.vertices),
        "tets": len(problem.mesh.tets),
        "samples": len(snapshots),
        "dimension": model.dimension,
        "converged": int(snapshots.converged.sum()),
        "iterations_mean": float(np.mean([r.iterations for r in snapshots.reports])),
        "inverted_tets_max": max(r.inverted_tets for r in snapshots.reports),
        "seconds": dict(
            zip(("mean_shape", "snapshots", "reduction"), stages.tolist(), strict=True)
        ),
        "total_seconds": total,
        "fitting_seconds": fitting,
        "fits": [vars(fit) for fit in fits],
        "drag_ms": {
            "solve_median": float(np.median(solve)),
            "frame_median": float(np.median(frame)),
            "frame_p99": float(np.percentile(frame, 99)),
        },
        "validation": errors,
    }
    rows = [
        ("poses", ", ".join(poses.names), ""),
        ("vertices / tets", f"{result['vertices']} / {result['tets']}", ""),
        ("fitting the poses, s", fitting, "not in the sum"),
        ("mean shape, s", float(stages[0]), ""),
        ("snapshots, s", float(stages[1]), ""),
        ("basis + coefficients, s", float(stages[2]), ""),
        ("mean + snapshots + reduction, s", total, f"<= {chosen.goal:g}"),
        ("samples converged", f"{result['converged']} of {len(snapshots)}", ""),
        ("iterations, mean", result["iterations_mean"], ""),
        ("inverted tets in a blend, max", result["inverted_tets_max"], ""),
        ("projection error, mean", errors["projection_error"]["mean"], ""),
        ("reduced error, mean", errors["error"]["mean"], "<= 0.001" if args.set == "helix" else ""),
        ("reduced error, median", errors["error"]["median"], ""),
        ("reduced error, max", errors["error"]["max"], ""),
        ("solve in a drag, ms median", float(np.median(solve)), ""),
        ("frame in a drag, ms median", float(np.median(frame)), "<= 3"),
        ("frame in a drag, ms 99 %", float(np.percentile(frame, 99)), ""),
    ]
    for fit in fits:
        rows.append(
            (
                f"{fit.name}: rms / max of the diagonal",
                f"{fit.rms:.2g} / {fit.max:.2g}",
                "rms <= 0.002",
            )
        )
        rows.append(
            (
                f"{fit.name}: inverted tets, stretch",
                f"{fit.inverted_tets}, {fit.smallest_stretch:.2g} to {fit.largest_stretch:.2g}",
                "0",
            )
        )
    common.show(f"{args.set}; {chosen.paper}", rows, result, args.json)


if __name__ == "__main__":
    main()
