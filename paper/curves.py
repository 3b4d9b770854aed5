"""Beyond the paper: error against dimension, against milliseconds and against seconds.

All subspaces of one problem, in both materials, on unseen motions. "full" sums over all tets, so
that the subspaces alone are compared; frames of a live session take the exact quartic of St.Venant-
Kirchhoff, or a cubature trained on our snapshots. Seconds of preparation are those of the subspace
and of the reduced energy. The snapshots' seconds count for our subspaces only, though rivals'
cubatures use the snapshots too.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import snapspace as ss
from snapspace.pictures import Curve, chart, save_png
from snapspace.validation import unseen_errors

from . import rivals
from .cached import training_with_seconds, unseen
from .cases import MATERIALS, read
from .curves_orderings import curves_in_order
from .live import drag
from .minimisers import projection_errors, relative_errors
from .orderings import Rows
from .result import Result
from .rivals.vibration_modes import forget_factors

Build = Callable[[ss.PosingProblem, int], ss.AffineSubspace]


@dataclass(frozen=True)
class Setting:
    """samples : for our subspaces; dimensions : of all; unseen : number of test motions."""

    samples: int
    dimensions: tuple[int, ...]
    unseen: int


FULL = Setting(300, (12, 24, 36), 5)
QUICK = Setting(60, (12, 24), 6)
RIVALS: dict[str, Build] = {
    "VM": rivals.vibration_subspace,
    "VM + MD": rivals.modal_subspace,
    "biharmonic": rivals.biharmonic_subspace,
    "radial basis": rivals.radial_basis_subspace,
    "linear responses": rivals.response_subspace,
    "skinning modes": rivals.skinning_subspace,
}


def run(*, quick: bool = False) -> Result:
    """The Dragon in the paper's material and in stable neo-Hookean."""
    result = Result("curves", "error, milliseconds and seconds of all subspaces")
    for kind in MATERIALS:
        _add(result, kind, QUICK if quick else FULL, quick=quick)
    return result


faults = curves_in_order


def _add(result: Result, kind: str, setting: Setting, *, quick: bool) -> None:
    case = read("dragon", kind, quick=quick)
    problem = case.problem
    assert isinstance(problem, ss.PosingProblem)
    snapshots, sampling = training_with_seconds(problem, setting.samples)
    reference = unseen(problem, setting.unseen)
    ours = {"ours": _ours(snapshots), "ours, mass alone": _ours(snapshots, handle_weight=0.0)}
    for name, build in (ours | RIVALS).items():
        known: set[int] = set()
        for d in setting.dimensions:
            forget_factors()
            begin = time.perf_counter()
            subspace = build(problem, d)
            if subspace.dimension in known:
                continue  # some rivals have no smaller subspace, or no larger one
            known.add(subspace.dimension)
            model = ss.reduce(problem, subspace, snapshots=snapshots)
            seconds = time.perf_counter() - begin + (sampling if name in ours else 0.0)
            errors = relative_errors(subspace, reference, model=model)
            result.add(
                shape=case.shape,
                material=kind,
                subspace=name,
                d=subspace.dimension,
                projection=float(projection_errors(subspace, reference).mean()),
                error=float(errors.mean()),
                **{"error live": float(np.mean(unseen_errors(model, reference)))},
                **{"ms a frame": drag(model).milliseconds, "seconds": seconds},
            )


def _ours(snapshots: ss.Snapshots, handle_weight: float | None = None) -> Build:
    def build(_: ss.PosingProblem, d: int) -> ss.AffineSubspace:
        if handle_weight is None:
            return ss.snapshot_pca(snapshots, dimension=d)
        return ss.snapshot_pca(snapshots, dimension=d, handle_weight=handle_weight)

    return build


def draw(rows: Rows, folder: Path) -> None:
    """Writes curves_d_MATERIAL.png, curves_ms_MATERIAL.png and curves_seconds_MATERIAL.png."""
    axes = {
        "d": ("d", "error", "d", "mean error on unseen motions"),
        "ms": ("ms a frame", "error live", "milliseconds a frame", "mean error of live frames"),
        "seconds": ("seconds", "error live", "seconds of preparation", "mean error of live frames"),
    }
    for kind in dict.fromkeys(row["material"] for row in rows):
        for name, (x, y, x_name, y_name) in axes.items():
            curves = []
            for subspace in dict.fromkeys(row["subspace"] for row in rows):
                points = [r for r in rows if (r["material"], r["subspace"]) == (kind, subspace)]
                if points:
                    xs, ys = [r[x] for r in points], [r[y] for r in points]
                    curves.append(Curve(subspace, xs, ys))
            title = f"{rows[0]['shape']}, {kind}"
            picture = chart(curves, title=title, x_name=x_name, y_name=y_name, size=(720, 440))
            save_png(folder / f"curves_{name}_{kind}.png", picture)
