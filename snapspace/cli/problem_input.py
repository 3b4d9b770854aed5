"""The problem that `snapspace build` solves, with tets from a file or inside a surface."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..filling import SurfaceFilling
from ..input_error import located
from ..mesh import (
    SURFACE_SUFFIXES,
    EmbeddedSurface,
    SurfaceFile,
    TetMesh,
    embed_file,
    open_surface,
    read_tets,
    shell_of_file,
    write_tets,
)
from ..mesh.embed_surface import WHOLE_DIAGONAL
from ..problem import (
    PosingProblem,
    check_problem,
    problem_surface_file,
    problem_thickness,
    read_problem,
    read_problem_surface,
)
from .console import notice
from .filling_options import check_unfilled, filled


@dataclass(frozen=True, kw_only=True)
class ProblemInput:
    """The input of a build.

    surface : surface that models show; None for the boundary of the tets, or a shell's triangles
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
    thickness: float | None = None,
) -> ProblemInput:
    """Reads a problem.

    Parameters
    ----------
    problem_file : Path
    mesh_file : Path, optional
        Tets or a surface, instead of the problem file's own.
    filling : SurfaceFilling
        How a surface is filled, if there are no tets.
    repair : bool
        Whether tets are repaired.
    tets_file : Path
        Where tets by fTetWild are saved, since they differ from run to run.
    thickness : float, optional
        Thickness of the shell that the surface becomes. Default: the problem file's.

    Raises
    ------
    ValueError
        If a file cannot be read or filled, or a filling is chosen but nothing is filled.
    """
    if mesh_file is None:
        mesh_file = problem_surface_file(problem_file)
    shell = problem_thickness(problem_file) if thickness is None else thickness
    if shell is not None:
        check_unfilled(filling, "a shell is not filled")
        if repair:
            raise ValueError(
                "--repair is for tets, but a shell has none; `snapspace check --fix` mends surfaces"
            )
        return _shell_input(problem_file, mesh_file, shell)
    if mesh_file is not None and mesh_file.suffix.lower() in SURFACE_SUFFIXES:
        check_problem(problem_file)
        if repair:
            raise ValueError(
                f"--repair is for tets, but {mesh_file} is a surface, which is mended when it is "
                "filled; leave it out"
            )
        file = open_surface(mesh_file).compact()
        tets = _tets(file, filling, tets_file)
        problem = read_problem(problem_file, mesh=tets)
        surface = embed_file(file, tets, farthest=WHOLE_DIAGONAL)
        source = _source(problem_file, mesh_file)
        return ProblemInput(problem=problem, surface=surface, source=source)
    check_unfilled(filling, f"{mesh_file or 'the mesh of the problem'} has tets already")
    given = None if mesh_file is None else read_tets(mesh_file, repair=repair)
    problem = read_problem(problem_file, mesh=given, repair=repair)
    own = read_problem_surface(problem_file, problem.mesh)
    return ProblemInput(problem=problem, surface=own, source=_source(problem_file, mesh_file))


def _shell_input(
    problem_file: Path, surface_file: Path | None, thickness: float | NDArray[np.float64]
) -> ProblemInput:
    if surface_file is None or surface_file.suffix.lower() not in SURFACE_SUFFIXES:
        name = problem_file if surface_file is None else surface_file
        raise ValueError(
            f"{name}: a shell is made of a surface ({', '.join(SURFACE_SUFFIXES)}), not of tets; "
            "name one on the command line, or in the problem's entry 'surface'"
        )
    with located(surface_file):
        mesh, surface = shell_of_file(open_surface(surface_file), thickness=thickness)
    problem = read_problem(problem_file, mesh=mesh)
    source = _source(problem_file, surface_file)
    return ProblemInput(problem=problem, surface=surface, source=source)


def _tets(file: SurfaceFile, filling: SurfaceFilling, kept: Path) -> TetMesh:
    tets, differ = filled(file.name, file.vertices, file.faces, filling)
    notice(f"filled {file.name} with {len(tets.tets):,} tets")
    if differ:
        write_tets(kept, tets)
        notice(f"wrote {kept}; give it in place of {file.name} to use the same tets again")
    return tets


def _source(problem_file: Path, mesh_file: Path | None) -> dict[str, Any]:
    content = json.loads(problem_file.read_text(encoding="utf-8-sig"))
    mesh = Path(content["mesh"]) if mesh_file is None else mesh_file
    kept = {key: content[key] for key in ("up", "mirror") if key in content}
    return {"problem": problem_file.name, "mesh": mesh.name} | kept
