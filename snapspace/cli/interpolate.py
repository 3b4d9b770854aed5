"""`snapspace interpolate`: makes a model file from several poses."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

import click
from rich import box
from rich.table import Table
from rich.text import Text

from ..accurate import BLENDS, check_budget
from ..arguments import check_target
from ..cubature import FEWEST_BLENDS
from ..filling import SurfaceFilling
from ..fitting import DEVIATION, PoseFit, check_deviation
from ..mesh import write_tets
from ..problem import InterpolationProblem, Poses, Simplex, usual_projection
from ..registration import SCALE_POLICIES, ScalePolicy
from .accurate_pipeline import chosen_build
from .blend_material import blend_material, material_options
from .build import check_output
from .build_advice import Suggestions, build_advice
from .choices import WEIGHT_SAMPLINGS, Choices, choice_options
from .console import notice, print_json, print_next, print_table
from .dask_cluster import dask_executor
from .files import make_folder
from .filling_options import check_unfilled, filling_options
from .fit_cache import FitCache
from .given_options import given_options
from .options import FILE, SHARE, TET_COUNT, dask_option, json_option, shell_option, threads_option
from .pose_differences import check_poses_differ
from .pose_files import PoseOptions, PoseSet, read_poses
from .printable import printable
from .summary import print_summary
from .target_error import BLENDS_DECIDING, decided_by_hand, notice_decided, target_option

SAMPLES, DIMENSION = 40, 30


@click.command(short_help="Make a model that blends poses.")
@click.argument("files", nargs=-1, required=True, type=FILE, metavar="POSE POSE ...")
@click.option(
    "-o", "--output", type=FILE, required=True, metavar="M.snapspace", help="Model file to write."
)
@click.option(
    "--tets",
    type=FILE,
    metavar="FILE",
    help="Tet mesh of the first surface: it begins with the surface's vertices, or encloses it "
    "[default: the surface is filled].",
)
@filling_options
@click.option(
    "--deviation",
    type=SHARE,
    help="Rms distance at which surface fits end, relative to the diagonal; a larger one fits "
    f"less tightly [default: {DEVIATION:g}].",
)
@shell_option
@click.option(
    "--scale",
    type=click.Choice(SCALE_POLICIES),
    default="auto",
    show_default=True,
    help="Scale poses to the size of the first: always (match), never (keep), or if the factor is "
    "so large that the unit of length must differ (auto).",
)
@click.option(
    "--accept-inverted", is_flag=True, help="Accept inverted tets in poses after the first."
)
@click.option(
    "--save-poses", type=FILE, metavar="DIR", help="Also write the tets of every pose, as .msh."
)
@click.option(
    "--extrapolation",
    type=click.FloatRange(min=0.0),
    default=0.0,
    show_default=True,
    help="Enlarge the sampled simplex by this share.",
)
@material_options
@target_option(BLENDS.target, error="Mean error on unseen blends", deciding=BLENDS_DECIDING)
@click.option(
    "--cubature-tets",
    type=TET_COUNT,
    metavar="N",
    help="Number of tets of the reduced energy, a sum over a few tets [default: 15 per mode, at "
    "most 1000; for arap with --shell 8 vertices per mode].",
)
@choice_options(samples=SAMPLES, dimension=DIMENSION, sampling=None, samplings=WEIGHT_SAMPLINGS)
@click.option("--repair", is_flag=True, help="Repair the mesh of --tets if it can be repaired.")
@threads_option
@dask_option
@json_option
def interpolate(
    files: Sequence[Path],
    output: Path,
    tets: Path | None,
    edge_length: float | None,
    exact: bool,
    deviation: float | None,
    thickness: float | None,
    scale: ScalePolicy,
    accept_inverted: bool,
    save_poses: Path | None,
    extrapolation: float,
    kind: str | None,
    lam: float,
    mu: float,
    radius: float | None,
    target_error: float,
    budget: float | None,
    cubature_tets: int | None,
    choices: Choices,
    repair: bool,
    threads: int | None,
    dask: str | None,
    as_json: bool,
) -> None:
    """Build a model that blends poses of one object along elastic paths.

    Poses are surfaces (.obj, .off, .ply) with the same faces, or tet meshes (.mesh, .msh, ...) with
    the same tets; vertex i of all poses is the same point of the object. Each pose may have its own
    frame. Surfaces are filled with tets in the first pose, and the tets are fitted to the others;
    with --shell they are blended as they are, even if they are open.

    Samples and dimension follow from the error on unseen blends (--target-error), unless given.

    Ctrl-C keeps finished poses and samples beside the model; the same command resumes.

    \b
    Examples:
      snapspace interpolate cylinder.mesh helix.mesh --samples 30 -o helix.snapspace
      snapspace interpolate stand.obj sit.obj run.obj -o cat.snapspace
      snapspace interpolate stand.off sit.off --tets stand.mesh -o cat.snapspace
      snapspace interpolate calm.obj smile.obj --shell 0.02 -o face.snapspace
    """
    begin = time.perf_counter()
    check_output(output)
    if len(files) < 2:
        raise ValueError(f"interpolate needs two poses or more, got {len(files)}")
    filling = SurfaceFilling(edge_length=edge_length, exact=exact)
    if tets is not None:
        check_unfilled(filling, "--tets has them")
    material = blend_material(kind, lam=lam, mu=mu, radius=radius, shell=thickness is not None)
    domain = Simplex(corners=len(files), extrapolation=extrapolation)
    recipe = choices.recipe(domain, dimension=DIMENSION, threads=threads, known=len(files))
    choices.check_clamp(usual_projection(material, shell=thickness is not None))
    check_target(target_error)
    check_budget(budget)
    recipe = replace(recipe, tets=cubature_tets)
    quartic = material.exact_degree == 4 and thickness is None
    if quartic and cubature_tets is not None:
        raise ValueError(
            "--cubature-tets is for materials whose reduced energy is a sum over a few tets, but "
            "that of stvk is exact; leave it out"
        )
    by_hand = decided_by_hand(exact=quartic, deciding=BLENDS_DECIDING)
    if not quartic and choices.samples < FEWEST_BLENDS:
        raise ValueError(
            f"the energy is a cubature, which needs at least {FEWEST_BLENDS} samples, but there is "
            f"{choices.samples}; raise --samples, or use --material stvk"
        )
    if deviation is not None:
        check_deviation(deviation)
    if save_poses is not None:
        make_folder(save_poses, option="--save-poses")
    executor = click.get_current_context().with_resource(dask_executor(dask))
    cache = FitCache.beside(output)
    options = PoseOptions(
        tets=tets,
        # a gap that tets close in the first pose may be wide in another one
        filling=replace(filling, most_closed=0),
        deviation=deviation,
        thickness=thickness,
        scale=scale,
        accept_inverted=accept_inverted,
        repair=repair,
        threads=threads,
    )
    pose_set = read_poses(files, options, cache)
    print_fits(pose_set.fits)
    problem = InterpolationProblem(pose_set.poses, material=material, extrapolation=extrapolation)
    try:
        check_poses_differ(problem.spread, problem.mesh.diagonal)
    except ValueError:
        cache.remove()
        raise
    if save_poses is not None:
        _save_poses(save_poses, pose_set)
    source: dict[str, Any] = {
        "poses": [file.name for file in files],
        "tets": None if tets is None else tets.name,
        "fits": [asdict(fit) for fit in pose_set.fits],
        "pose_seconds": pose_set.seconds,
        "options": given_options(),
    }
    if not quartic:
        notice_decided(BLENDS_DECIDING)
    build = chosen_build(
        problem,
        recipe,
        by_hand=by_hand,
        target_error=target_error,
        budget=budget,
        seed=choices.seed,
        solver=choices.solver_options(),
    )
    try:
        built = build(
            output,
            source=source,
            surface=pose_set.surface,
            begin=begin,
            executor=executor,
        )
    except KeyboardInterrupt as stop:
        kept = "; the fitted poses are kept" if pose_set.fits else ""
        raise KeyboardInterrupt(f"{stop}{kept}") from None
    built = replace(built, seconds={**pose_set.seconds, **built.seconds})
    cache.remove()
    print_summary(built, include_unconverged=choices.include_unconverged)
    inputs = [*files, *([] if tets is None else [tets])]
    better = build_advice(built, folders=[file.parent for file in inputs], threads=threads)
    _print_next(output, len(pose_set.poses), better)
    if as_json:
        print_json({**built.as_json(), "poses": len(pose_set.poses), "fits": source["fits"]})


def print_fits(fits: Sequence[PoseFit]) -> None:
    """How far the fitted poses are from their surfaces, as a table on standard error."""
    if not fits:
        return
    table = Table(
        title="fitted poses; distances relative to the diagonal",
        title_justify="left",
        title_style="bold",
        box=box.SIMPLE_HEAD,
    )
    table.add_column("")
    for name in ("rms", "max", "inverted", "stretch", "seconds"):
        table.add_column(name, justify="right")
    for fit in fits:
        table.add_row(
            Text(printable(fit.name)),  # not as markup
            f"{fit.rms:.2g}",
            f"{fit.max:.2g}",
            str(fit.inverted_tets),
            f"{fit.smallest_stretch:.2g} to {fit.largest_stretch:.2g}",
            f"{fit.seconds:.2g}",
        )
    print_table(table)
    for fit in fits:
        if fit.status != "converged":
            notice(
                f"notice: {fit.name} ended with {fit.status}, {fit.rms:.2g} from its surface, and "
                "is blended as it was fitted; --save-poses DIR writes that shape, and --shell "
                "THICKNESS blends surfaces without fits"
            )


def _save_poses(folder: Path, pose_set: PoseSet) -> None:
    poses = pose_set.poses
    assert isinstance(poses, Poses)  # --shell refuses --save-poses
    for name, shape in zip(poses.names, poses.shapes, strict=True):
        file = folder / f"{name.replace('/', '-').replace(': ', '-')}.msh"
        write_tets(file, poses.reference, vertices=shape)


def _print_next(output: Path, poses: int, better: Suggestions) -> None:
    equal = ",".join(["0.5", "0.5", *["0"] * (poses - 2)])
    print_next(
        [
            ("blend it in the browser", ["view", output]),
            ("how far it is from the full solution", ["validate", output]),
            ("one blend", ["blend", output, "--weights", equal, "-o", "blend.obj"]),
            (
                "a path through all poses, with the linear one",
                ["blend", output, "--path", "30", "-o", "frames", "--linear", "--png", "path.png"],
            ),
            *better,
        ]
    )
