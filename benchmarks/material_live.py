"""Errors of frames against full solutions: part `live` of materials.py."""

from __future__ import annotations

import argparse
import time
from collections.abc import Iterator
from typing import Any

import common
import numpy as np
import problems

import snapspace as ss

FRAMES = 300
#: Samples and d of problems with one moving handle, and with several.
SAMPLES, DIMENSIONS = (800, 1600), (120, 180)


def live(name: str, args: argparse.Namespace) -> Iterator[dict[str, Any]]:
    """Errors of frames after one jump from rest, relative to the displacement, by material.

    They are measured against tight full solutions at unseen parameters. "Cold" is such a jump,
    "warm" a frame of a drag; both are the solve alone, without the vertices.
    """
    for kind in args.material:
        body = common.with_material(problems.read(name), kind)
        several = body.parameter_count > 6
        count = args.samples or SAMPLES[several]
        samples = ss.sample(body.domain, count, method="sobol", seed=args.seed)
        begin = time.perf_counter()
        snapshots = common.solved(body, samples, tolerance=args.tolerance, max_iterations=3000)
        solved = time.perf_counter()
        used = snapshots.select(snapshots.converged)
        subspace = ss.snapshot_pca(used, dimension=args.dimension or DIMENSIONS[several])
        tets = min(args.tets, len(body.mesh.tets))
        model = ss.reduce(body, subspace, snapshots=used, energy="cubature", tets=tets)
        reduced = time.perf_counter()
        found = ss.validate(model, samples=args.validate or 30)
        warm, _ = common.drag(model, frames=FRAMES, seed=args.seed + 1)
        held = model.provenance["cubature"]["held_out"]
        yield {
            "problem": name,
            "half": "choosing" if name in problems.CHOOSING else "judging",
            "material": kind,
            "parameters": body.parameter_count,
            "samples": f"{len(used)} of {len(samples)}",
            "evaluations": float(np.mean([r.evaluations for r in snapshots.reports])),
            "d": subspace.dimension,
            "tets": model.provenance["cubature"]["tets"],
            "median": float(np.median(found.error)),
            "mean": float(found.error.mean()),
            "max": float(found.error.max()),
            "projection": float(np.median(found.projection_error)),
            "projection, mean": float(found.projection_error.mean()),
            "cubature": held["displacement_median"],
            "warm ms": float(np.median(warm)),
            "cold ms": float(np.median(found.solve_ms)),
            "inverted": int(np.max([r.inverted_tets for r in found.reference.reports])),
            "samples s": solved - begin,
            "model s": reduced - solved,
        }
