"""`snapspace build`: makes a model file from a problem file."""

from __future__ import annotations

import os
import time
from dataclasses import replace
from pathlib import Path

import click

from ..accurate import MOTIONS, check_budget
from ..arguments import check_target
from ..filling import SurfaceFilling
from ..model_file import check_model_path, load
from ..problem import PosingProblem, is_quartic
from ..reduction import STORED_ENERGIES, Energy, PosingModel
from .accurate_pipeline import chosen_build
from .build_advice import build_advice
from .choices import MOTION_SAMPLINGS, Choices, choice_options
from .console import print_json, print_next
from .dask_cluster import dask_executor
from .energy import EnergyChoice
from .filling_options import filling_options
from .first_motion import first_motion
from .given_options import given_options
from .options import FILE, TET_COUNT, dask_option, json_option, shell_option, threads_option
from .problem_input import problem_input
from .problem_notices import notice_odd_problem
from .summary import print_summary
from .target_error import MOTIONS_DECIDING, decided_by_hand, notice_decided, target_option

DIMENSION = 40


@click.command(short_help="Make a model from a problem.")
@click.argument("mesh", type=FILE, required=False)
@click.option(
    "--problem", "problem_file", type=FILE, required=True, metavar="P.json", help="Problem file."
)
@click.option(
    "-o", "--output", type=FILE, required=True, metavar="M.snapspace", help="Model file to write."
)
@target_option(MOTIONS.target, error="Median error on unseen motions", deciding=MOTIONS_DECIDING)
@click.option(
    "--from",
    "from_file",
    type=FILE,
    metavar="OLD.snapspace",
    help="A model of the same mesh with other handles. The first model is made from its shapes, in "
    "a fraction of the time, and is kept if it meets --target-error.",
)
@choice_options(samples=300, dimension=DIMENSION, sampling="sobol", samplings=MOTION_SAMPLINGS)
@click.option(
    "--energy",
    type=click.Choice(STORED_ENERGIES),
    default="auto",
    show_default=True,
    help="Reduced energy. exact: a quartic, for St.Venant-Kirchhoff, up to about 60 modes. "
    "cubature: a sum over a few tets, for all materials; its samples are solved more tightly. "
    "auto: exact if the material allows it, up to 48 modes.",
)
@click.option(
    "--tets",
    type=TET_COUNT,
    metavar="N",
    help="Number of tets, or triangles and hinges, of a cubature [default: 8 per mode, but at "
    "most the larger of 1000 and 6.5 per mode; for a shell 12 per mode, at most 1500].",
)
@shell_option
@click.option("--repair", is_flag=True, help="Repair the mesh if it can be repaired.")
@filling_options
@threads_option
@dask_option
@json_option
def build(
    mesh: Path | None,
    problem_file: Path,
    output: Path,
    energy: Energy,
    tets: int | None,
    thickness: float | None,
    repair: bool,
    edge_length: float | None,
    exact: bool,
    target_error: float,
    budget: float | None,
    from_file: Path | None,
    choices: Choices,
    threads: int | None,
    dask: str | None,
    as_json: bool,
) -> None:
    """Build a model: solve the samples, find the subspace, precompute the reduced energy.

    Samples and dimension follow from the error on unseen motions, see --target-error, unless you
    give them. MESH, tets or a surface, replaces the mesh that the problem file names. A surface is
    filled with tets, or with --shell becomes a thin shell. Ctrl-C keeps the finished samples beside
    the model; the same command resumes from there.

    \b
    Examples:
      snapspace build --problem dragon.json -o dragon.snapspace
      snapspace build --problem spot.json spot.obj -o spot.snapspace
      snapspace build --problem cloth.json cloth.obj --shell 0.01 -o cloth.snapspace
      snapspace build --problem tail.json --from dragon.snapspace -o tail.snapspace
      snapspace build --problem dragon.json --samples 600 --dimension 60 -o dragon60.snapspace
      snapspace build --problem dragon.json --dimension 120 --energy cubature -o dragon120.snapspace
      snapspace build --problem dragon.json finer.msh --energy-fraction 0.9999 -o finer.snapspace
    """
    begin = time.perf_counter()
    check_output(output)
    check_target(target_error)
    check_budget(budget)
    given = problem_input(
        problem_file,
        mesh,
        filling=SurfaceFilling(edge_length=edge_length, exact=exact),
        repair=repair,
        tets_file=output.with_name(f"{output.stem}-tets.msh"),
        thickness=thickness,
    )
    problem, source = given.problem, given.source
    notice_odd_problem(problem)
    quartic = is_quartic(problem)
    by_hand = decided_by_hand(exact=quartic, deciding=MOTIONS_DECIDING)
    dimension = None if choices.energy_fraction else choices.dimension or DIMENSION
    choice = EnergyChoice(energy=energy, tets=tets, dimension=dimension)
    choice.check(problem, choices.samples)
    recipe = choices.recipe(
        problem.domain,
        dimension=DIMENSION,
        threads=threads,
        tolerance=choice.tolerance(problem),
    )
    choices.check_clamp(problem.solving.projection)
    recipe = replace(recipe, energy=energy, tets=tets)
    executor = click.get_current_context().with_resource(dask_executor(dask))
    source["options"] = given_options()
    if not quartic:
        notice_decided(MOTIONS_DECIDING)
    make = chosen_build(
        problem,
        recipe,
        by_hand=by_hand,
        target_error=target_error,
        budget=budget,
        seed=choices.seed,
        start=None if from_file is None else _old_model(from_file, problem),
        solver=choices.solver_options(),
    )
    built = make(output, source=source, surface=given.surface, begin=begin, executor=executor)
    print_summary(built, include_unconverged=choices.include_unconverged)
    folders = [file.parent for file in (problem_file, mesh) if file is not None]
    better = build_advice(built, folders=folders, threads=threads)
    suggestions: list[tuple[str, list[str | Path]]] = [
        ("drag it in the browser", ["view", output]),
        ("how far it is from the full solution", ["validate", output]),
        ("one pose", ["pose", output, *first_motion(problem), "-o", "posed.obj"]),
    ]
    print_next([*suggestions, *better])
    if as_json:
        print_json(built.as_json())


def check_output(output: Path) -> None:
    """Raises ValueError unless a model file can be written there, before any work is done."""
    check_model_path(output)
    if output.is_dir():
        raise ValueError(f"{output}: this is a folder; give a file name")
    if not os.access(output.parent, os.W_OK):
        raise ValueError(f"{output}: the folder {output.parent} cannot be written to")


def _old_model(file: Path, problem: PosingProblem) -> PosingModel:
    """The model of --from; ValueError if it has no handles, or another mesh."""
    model = load(file)
    if not isinstance(model, PosingModel):
        raise ValueError(f"{file}: this model blends poses; --from takes one with handles")
    old, mesh = model.problem.mesh, problem.mesh
    if old.fingerprint != mesh.fingerprint:
        raise ValueError(
            f"{file}: this is a model of another mesh, {old!r}; --from needs one of {mesh!r}. Tets "
            "by fTetWild differ in every run: give as MESH the file *-tets.msh that the first "
            "build wrote; or leave out --from"
        )
    return model
