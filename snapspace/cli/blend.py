"""`snapspace blend`: shapes between the poses of a model, as files."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any

import click
import numpy as np
from numpy.typing import NDArray

from ..mesh.input_path import writable_path
from ..pictures import save_png
from ..reduction import InterpolationModel
from .blend_path import path_weights
from .blend_picture import blend_picture
from .blend_shape import BlendedShape, shape_at, write_blended
from .console import notice, print_facts, print_json
from .files import SURFACE_OUTPUTS, TET_OUTPUTS, make_folder
from .loading import load_interpolation
from .options import FILE, json_option, leading_option, parse_numbers, up_option

FORMATS = tuple(suffix.removeprefix(".") for suffix in SURFACE_OUTPUTS + TET_OUTPUTS)


@click.command(short_help="Blend poses and write the shapes.")
@click.argument("model_file", type=FILE, metavar="M.snapspace")
@click.option("--weights", metavar="W,W,...", help="One weight per pose; they sum to one.")
@click.option(
    "--path",
    "frames",
    type=click.IntRange(min=2),
    metavar="N",
    help="Instead of --weights: N shapes from the first pose through all poses to the last.",
)
@click.option(
    "-o",
    "--output",
    type=FILE,
    metavar="FILE|DIR",
    help="Surface as .obj, .ply, .off, .stl, or all tets as .msh, .vtu, .vtk, .mesh. With --path a "
    "folder.",
)
@click.option(
    "--format",
    "kind",
    type=click.Choice(FORMATS),
    help="Of the files in the folder of --path [default: obj].",
)
@click.option(
    "--linear", is_flag=True, help="Also write the straight blend, as NAME-linear, to compare with."
)
@click.option("--extrapolate", is_flag=True, help="Take weights outside of the sampled simplex.")
@click.option("--png", type=FILE, metavar="FILE", help="Also a picture of the shapes.")
@up_option
@leading_option
@json_option
def blend(
    model_file: Path,
    weights: str | None,
    frames: int | None,
    output: Path | None,
    kind: str | None,
    linear: bool,
    extrapolate: bool,
    png: Path | None,
    up: str,
    dimension: int | None,
    as_json: bool,
) -> None:
    """Blend the poses of a model and write the shapes.

    \b
    Examples:
      snapspace blend lion.snapspace --weights 0.3,0.7 -o out.obj
      snapspace blend centaur.snapspace --path 60 -o frames/ --linear --png path.png
    """
    if (weights is None) == (frames is None):
        raise ValueError("give either --weights or --path")
    if kind is not None and frames is None:
        raise ValueError("--format is for --path; the extension of -o tells the format of one file")
    model = load_interpolation(model_file, dimension)
    wanted = _wanted(model, weights, frames, extrapolate=extrapolate)
    _check_outputs(output, png, folder=frames is not None)
    session = model.session()
    shapes: list[BlendedShape] = []
    for w in wanted:
        shapes.append(shape_at(model, session, w, linear=linear, extrapolate=extrapolate))
    _check(shapes)
    begin = time.perf_counter()
    written = _write(model, shapes, output, kind=kind or "obj", folder=frames is not None)
    if png is not None:
        save_png(png, blend_picture(model, shapes, up=up))
        written.append(png)
    figures = _figures(shapes, written, time.perf_counter() - begin)
    _print_report(figures)
    if as_json:
        print_json({"dimension": model.dimension, **figures})


def _wanted(
    model: InterpolationModel, weights: str | None, frames: int | None, *, extrapolate: bool
) -> NDArray[np.float64]:
    """The weights of all shapes, (k, poses)."""
    poses = len(model.problem.poses)
    if weights is None:
        assert frames is not None
        return path_weights(poses, frames)
    numbers = parse_numbers(weights)
    if not extrapolate and min(numbers) < model.problem.domain.lowest - 1e-9:
        raise ValueError(
            f"--weights {weights}: {min(numbers):g} is below {model.problem.domain.lowest:g}, the "
            "least weight that was sampled; --extrapolate takes it all the same"
        )
    return model.problem.weights(numbers, extrapolate=extrapolate)[None, :]


def _check_outputs(output: Path | None, png: Path | None, *, folder: bool) -> None:
    """ValueError unless the files can be written: before anything is. Makes the folder."""
    if png is not None:
        writable_path(png, known=(".png",))
    if output is None:
        return
    if not folder:
        writable_path(output, known=SURFACE_OUTPUTS + TET_OUTPUTS)
        return
    make_folder(output, option="-o")


def _write(
    model: InterpolationModel,
    shapes: list[BlendedShape],
    output: Path | None,
    *,
    kind: str,
    folder: bool,
) -> list[Path]:
    if output is None:
        return []
    if folder:
        _notice_old_frames(output, len(shapes))
    written = []
    for number, shape in enumerate(shapes):
        path = output / f"frame-{number:04d}.{kind}" if folder else output
        written += write_blended(model, shape, path)
    return written


def _notice_old_frames(folder: Path, frames: int) -> None:
    """Frames of a longer path would follow those of this one in a film."""
    old = [path for path in folder.glob("frame-*.*") if _number(path) >= frames]
    if old:
        notice(f"notice: {folder} also holds {len(old)} files of a longer path; delete them")


def _number(frame: Path) -> int:
    digits = frame.stem.removesuffix("-linear").removeprefix("frame-")
    return int(digits) if digits.isdecimal() else -1


def _check(shapes: list[BlendedShape]) -> None:
    for shape in shapes:
        if shape.report.status == "unbounded":
            raise ValueError(
                f"--weights {','.join(f'{w:g}' for w in shape.weights)}: the energy has no minimum "
                "that far outside; choose weights nearer to the poses"
            )
    failed = [shape for shape in shapes if not shape.report.converged]
    if failed:
        notice(
            f"notice: {len(failed)} of {len(shapes)} solves ended with "
            f"{failed[0].report.status}; those shapes may be poor"
        )


def _figures(shapes: list[BlendedShape], written: list[Path], seconds: float) -> dict[str, Any]:
    return {
        "frames": [shape.as_json() for shape in shapes],
        "written": [str(path) for path in written],
        "writing_seconds": seconds,
    }


def _print_report(figures: dict[str, Any]) -> None:
    frames = figures["frames"]
    solve = np.median([frame["solve_ms"] for frame in frames])
    whole = np.median([frame["frame_ms"] for frame in frames])
    converged = sum(frame["status"] == "converged" for frame in frames)
    written = figures["written"]
    more = f" and {len(written) - 1} more" if len(written) > 1 else ""
    facts = [
        ("shapes", f"{len(frames)}, {converged} converged"),
        ("inverted tets", f"at most {max(frame['inverted_tets'] for frame in frames)}"),
        ("solve", f"{solve:.2f} ms, with all vertices {whole:.2f} ms"),
        (
            "written",
            f"{written[0]}{more}" if written else "nothing; -o FILE or --png FILE keeps shapes",
        ),
    ]
    print_facts("blended", facts)
