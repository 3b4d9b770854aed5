"""Numbers about model files, for `info`."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..mesh import ShellMesh
from ..model_file import load
from ..reduction import (
    BlendedStars,
    BlendedSum,
    Cubature,
    InterpolationModel,
    LocalRows,
    PosingModel,
    ReducedModel,
    has_stars,
)
from .accuracy_facts import accuracy_facts
from .mesh_info import Info, mesh_facts, mesh_figures
from .poses_info import poses_facts, poses_figures
from .problem_info import problem_facts, problem_figures
from .units import in_bytes, in_percent, in_time

_DIMENSIONS = (1, 2, 5, 10, 20, 30, 40, 60, 80, 100, 150, 200, 300)


def model_info(file: Path) -> Info:
    """JSON content and facts of a model file; ValueError if it is not one."""
    model = load(file)
    subspace, energies = model.subspace, model.subspace.snapshot_energies
    if isinstance(model, PosingModel):
        figures_of_problem = problem_figures(model.problem)
        facts_of_problem = problem_facts(figures_of_problem)
    else:
        figures_of_problem = poses_figures(model)
        facts_of_problem = poses_facts(figures_of_problem)
    figures: dict[str, Any] = {
        "kind": "model",
        "problem": "posing" if isinstance(model, PosingModel) else "interpolation",
        "bytes": file.stat().st_size,
        "dimension": model.dimension,
        "samples": len(model.training_parameters),
        "energy": energy_text(model),
        "energy_fraction": subspace.energy_fraction,
        "lumped_mass": subspace.lumped,
        "snapshot_energies": None if energies is None else energies.tolist(),
        **figures_of_problem,
        "mesh": mesh_figures(model.problem.mesh),
        "provenance": model.provenance,
    }
    facts = [
        ("dimension", f"{model.dimension}, from {figures['samples']} snapshots"),
        ("not captured", _decay(energies, model.dimension)),
        ("energy", figures["energy"]),
        ("file", in_bytes(figures["bytes"])),
        *facts_of_problem,
        *mesh_facts(figures["mesh"]),
        *_provenance_facts(model.provenance),
    ]
    return figures, facts


def energy_text(model: ReducedModel) -> str:
    """The kind of the reduced energy, as text."""
    if model.cubature is not None:
        what = "tets"
        if isinstance(model.problem.mesh, ShellMesh):
            rings = not model.problem.material.settings.get("radius")
            stars = "vertices with their triangles" if rings else "rigid neighbourhoods"
            what = stars if has_stars(model.problem) else "triangles and hinges"
        return f"cubature of {len(model.cubature.tets)} {what}{_clusters_text(model.cubature)}"
    if isinstance(model, InterpolationModel):
        return f"exact quartics of {len(model.problem.poses)} poses"
    return "exact quartic"


def _clusters_text(energy: Cubature | BlendedSum) -> str:
    """Text about its local coordinates, which follows the number of tets; empty without them."""
    if isinstance(energy, BlendedStars) or not isinstance(energy.stored_rows, LocalRows):
        return ""
    ranks = energy.stored_rows.sizes[:, 1]
    return f", in {len(ranks)} clusters with {ranks.mean():.0f} local coordinates each on average"


def _decay(energies: NDArray[np.float64] | None, dimension: int) -> str:
    """Relative error of the snapshots' projections onto d modes, for some d, as text."""
    if energies is None:
        return "unknown: the basis was not made from snapshots"
    tails = np.cumsum(energies[::-1])[::-1] / energies.sum()
    shown = sorted({d for d in _DIMENSIONS if d < dimension} | {dimension})
    errors = ((d, float(np.sqrt(tails[d])) if d < len(tails) else 0.0) for d in shown)
    return ", ".join(f"{in_percent(error)} at d = {d}" for d, error in errors)


def _provenance_facts(record: dict[str, Any]) -> list[tuple[str, str]]:
    """The recorded facts, for models of any origin: missing entries are left out."""
    facts = []
    for key in ("problem", "mesh", "tets"):
        if isinstance(record.get(key), str):
            facts.append((f"{key} file", record[key]))
    if isinstance(record.get("poses"), list):
        facts.append(("pose files", ", ".join(map(str, record["poses"]))))
    for key in ("sampling", "solver", "versions"):
        if isinstance(record.get(key), dict):
            facts.append((key, ", ".join(f"{name} {value}" for name, value in record[key].items())))
    facts += accuracy_facts(record)
    cubature = record.get("cubature")
    if isinstance(cubature, dict) and isinstance(cubature.get("held_out"), dict):
        errors = cubature["held_out"]
        facts.append(
            (
                "cubature errors",
                f"energy {in_percent(errors['energy_median'])}, "
                f"displacement {in_percent(errors['displacement_median'])}, median of "
                f"{errors['states']} held-out samples",
            )
        )
    snapshots, seconds = record.get("snapshots"), record.get("seconds")
    if isinstance(snapshots, dict) and "summary" in snapshots:
        facts.append(("snapshots", str(snapshots["summary"])))
    if isinstance(seconds, dict):
        times = (f"{name} {in_time(float(value))}" for name, value in seconds.items())
        facts.append(("time", ", ".join(times)))
    return facts
