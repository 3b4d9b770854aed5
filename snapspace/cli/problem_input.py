"""The problem that `snapspace build` solves, with tets from a file or inside a surface."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..filling import SurfaceFilling
from ..mesh import (
    SURFACE_SUFFIXES,
    EmbeddedSurface,
    SurfaceFile,
    TetMesh,
    embed_file,
    open_surface,
    read_tets,
    write_tets,
)
from ..mesh.embed_surface import WHOLE_DIAGONAL
from ..problem import PosingProblem, problem_surface_file, read_problem, read_problem_surface
from .console import notice
from .filling_options import filled


@dataclass(frozen=True, kw_only=True)
class ProblemInput:
    """What a model is built of.

    surface : that models show, or None for the boundary of the tets
    source : names of the files, for the model's provenance
    """

    problem: PosingProblem
    surface: EmbeddedSurface | None
    source: dict[str, Any]


def problem_input(
    problem_file: Path,
    mesh_file: Path | None,
    *,
    filling: SurfaceFilling,
    repair: bool,
    tets_file: Path,
) -> ProblemInput:
    """Reads a problem.

    Parameters
    ----------
    problem_file : Path
    mesh_file : Path, optional
        Tets, or a surface, in place of what the problem file names.
    filling : SurfaceFilling
        How a surface is filled, if there are no tets.
    repair : bool
        Whether tets are repaired.
    tets_file : Path
        Where tets of fTetWild are kept: it makes other ones in each run.

    Raises
    ------
    ValueError
        If a file cannot be read or filled.
    """
    if mesh_file is None:
        mesh_file = problem_surface_file(problem_file)
    if mesh_file is not None and mesh_file.suffix.lower() in SURFACE_SUFFIXES:
        file = open_surface(mesh_file).compact()
        tets = _tets(file, filling, tets_file)
        problem = read_problem(problem_file, mesh=tets)
        surface = embed_file(file, tets, farthest=WHOLE_DIAGONAL)
        source = _source(problem_file, mesh_file)
        return ProblemInput(problem=problem, surface=surface, source=source)
    given = None if mesh_file is None else read_tets(mesh_file, repair=repair)
    problem = read_problem(problem_file, mesh=given, repair=repair)
    own = read_problem_surface(problem_file, problem.mesh)
    return ProblemInput(problem=problem, surface=own, source=_source(problem_file, mesh_file))


def _tets(file: SurfaceFile, filling: SurfaceFilling, kept: Path) -> TetMesh:
    tets, differ = filled(file, filling)
    notice(f"filled {file.name} with {len(tets.tets):,} tets")
    if differ:
        write_tets(kept, tets)
        notice(f"wrote {kept}; give it in place of {file.name} to use the same tets again")
    return tets


def _source(problem_file: Path, mesh_file: Path | None) -> dict[str, Any]:
    content = json.loads(problem_file.read_text(encoding="utf-8"))
    mesh = Path(content["mesh"]) if mesh_file is None else mesh_file
    kept = {key: content[key] for key in ("up", "mirror") if key in content}
    return {"problem": problem_file.name, "mesh": mesh.name} | kept
