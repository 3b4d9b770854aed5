"""`snapspace demo`: runs the whole pipeline on a generated creature."""

from __future__ import annotations

import json
import time
from pathlib import Path

import click

from ..accurate import MOTIONS
from ..animation import write_shape
from ..disk.atomic_file import atomic_file
from ..extras import missing
from ..generators import creature
from ..mesh import write_tets
from ..page import export_html
from ..pictures import save_png
from ..problem import read_problem
from ..reduction import PosingModel
from ..sampling import sample
from ..snapshots import SolverOptions
from ..validation import validate
from .accurate_pipeline import chosen_build
from .build_advice import build_advice
from .console import notice, print_json, print_next
from .demo_creature import POSE_OF_OBJ, PROBLEM, contact_sheet, posed_shapes
from .files import make_folder
from .options import FILE, MODE_COUNT, SAMPLE_COUNT, SEED_NUMBER, json_option, threads_option
from .progress import sample_progress, spinner
from .recipe import Recipe, check_dimension
from .samples import GivenSamples, sampling_record
from .summary import print_summary
from .target_error import decided_by_hand
from .units import in_time
from .validation_tables import print_validation

VALIDATION_SAMPLES = 10


@click.command(short_help="Build and paint a model of a generated creature.")
@click.option(
    "--output",
    type=FILE,
    default=Path("snapspace-demo"),
    show_default=True,
    metavar="DIR",
    help="Folder for the files.",
)
@click.option(
    "--tets",
    type=click.IntRange(5_000, 1_500_000),
    default=20_000,
    show_default=True,
    help="Size of the creature.",
)
@click.option(
    "--samples",
    type=SAMPLE_COUNT,
    default=300,
    show_default="as many as the accuracy needs; 300 with --dimension",
)
@click.option(
    "--dimension",
    type=MODE_COUNT,
    default=40,
    show_default="as many as the accuracy needs; 40 with --samples",
)
@click.option("--seed", type=SEED_NUMBER, default=0, show_default=True)
@threads_option
@json_option
def demo(
    output: Path,
    tets: int,
    samples: int,
    dimension: int,
    seed: int,
    threads: int | None,
    as_json: bool,
) -> None:
    """Build a model of a generated creature, validate it, and paint some of its poses.

    The model is that of `snapspace build` without options, unless --samples or --dimension is
    given.
    Writes creature.msh, creature.json (the problem), creature.snapspace (the model), creature.html
    (a page to drag it in), creature.png (a contact sheet; needs snapspace[pictures]) and
    creature.obj (one pose).

    \b
    Example:
      snapspace demo --output creature --tets 50000
    """
    begin = time.perf_counter()
    files = {
        kind: output / f"creature.{kind}"
        for kind in ("msh", "json", "snapspace", "html", "png", "obj")
    }
    if missing("pictures"):
        del files["png"]
        notice('notice: no picture, which needs pillow: pip install "snapspace[pictures]"')
    check_dimension(dimension, samples)
    make_folder(output, option="--output")
    with spinner("generating the creature"):
        write_tets(files["msh"], creature(tets))
    with atomic_file(files["json"]) as path:
        path.write_text(json.dumps(PROBLEM, indent=1) + "\n", encoding="utf-8")

    problem = read_problem(files["json"])
    given = GivenSamples(sample(problem.domain, samples, method="sobol", seed=seed))
    recipe = Recipe(
        samples=given,
        sampling=sampling_record(given, "sobol", asked=samples, seed=seed, scramble=True),
        solver=SolverOptions(),
        dimension=dimension,
        threads=threads,
    )
    by_hand = decided_by_hand()
    build = chosen_build(
        problem,
        recipe,
        by_hand=by_hand,
        target_error=MOTIONS.target,
        seed=seed,
        solver=recipe.solver,
    )
    source = {
        "problem": files["json"].name,
        "mesh": files["msh"].name,
        "options": {"--samples": samples, "--dimension": dimension} if by_hand else {},
    }
    built = build(files["snapspace"], source=source, begin=begin)
    print_summary(built, include_unconverged=False)
    better = build_advice(built, folders=[output], threads=threads)
    with sample_progress("full solutions", total=VALIDATION_SAMPLES) as progress:
        validation = validate(
            built.model, samples=VALIDATION_SAMPLES, threads=threads, progress=progress
        )
    print_validation(validation, built.model.dimension, asked=VALIDATION_SAMPLES)

    assert isinstance(built.model, PosingModel)
    with spinner("painting"):
        shapes = posed_shapes(built.model)
        if "png" in files:
            save_png(files["png"], contact_sheet(built.model, shapes))
    write_shape(files["obj"], built.model, shapes[POSE_OF_OBJ])
    export_html(built.model, files["html"])
    seconds = time.perf_counter() - begin
    notice(f"done in {in_time(seconds)}: {', '.join(str(path) for path in files.values())}")
    notice(f"open {files['html']} in a browser and drag the head")
    print_next([*_suggestions(files), *better])
    if as_json:
        print_json(
            {
                "folder": str(output),
                "files": {kind: str(path) for kind, path in files.items()},
                "build": built.as_json(),
                "validation": validation.as_json(built.model.dimension),
                "seconds": seconds,
            }
        )


def _suggestions(files: dict[str, Path]) -> list[tuple[str, list[str | Path]]]:
    model, folder = files["snapspace"], files["obj"].parent
    head = ["--handle", "head", "--euler", "0,-30,20", "--translate", "0.1,0,0.1"]
    tail = ["--handle", "tail", "--euler", "-35,0,20", "--translate", "0,-0.3,0"]
    outputs = ["-o", str(folder / "mine.obj")]
    if "png" in files:
        outputs += ["--png", str(folder / "mine.png")]
    finer = ["--target-error", "0.002", "-o", str(folder / "finer.snapspace")]
    return [
        ("drag it in the browser", ["view", model]),
        ("a pose of your own", ["pose", model, *head, *tail, *outputs]),
        ("more about its error", ["validate", model, "--samples", "30"]),
        ("what it contains and how it was made", ["info", model]),
        ("a more accurate one", ["build", "--problem", files["json"], *finer]),
    ]
