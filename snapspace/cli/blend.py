"""`snapspace blend`: shapes between the poses of a model, as files."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any

import click
import numpy as np
from numpy.typing import NDArray

from ..animation import shape_suffix
from ..extras import need_extra
from ..mesh import ShellMesh
from ..mesh.input_path import writable_path
from ..pictures import save_png
from ..reduction import InterpolationModel
from ..session import BlendingSession
from .blend_extrapolation import certain_share, notice_uncertain, weights_text
from .blend_path import path_weights
from .blend_path_report import notice_jumps, path_facts, path_figures
from .blend_picture import blend_picture
from .blend_shape import BlendedShape, shape_at, write_blended
from .console import notice, print_facts, print_json
from .even_path import PathJump, even_path
from .frames import (
    check_frames_output,
    is_film,
    notice_old_frames,
    path_options,
)
from .loading import load_interpolation
from .options import FILE, json_option, leading_option, numbers_option, up_option
from .own_surface import (
    SHAPE_OUTPUTS,
    check_own_output,
    check_up,
    surface_option,
    with_surface,
)
from .progress import spinner
from .write_frames import write_frames

EVEN = ("shape", "weights")


@click.command(short_help="Blend poses and write the shapes.")
@click.argument("model_file", type=FILE, metavar="M.snapspace")
@numbers_option("--weights", metavar="W,W,...", text="One weight per pose; they sum to one.")
@click.option(
    "--path",
    "frames",
    type=click.IntRange(2, 1_000_000),
    metavar="N",
    help="Instead of --weights: N shapes from the first pose through all poses to the last.",
)
@click.option(
    "--even",
    type=click.Choice(EVEN),
    help="What changes evenly from frame to frame of --path: the shape, by the largest motion of a "
    "vertex, or the weights [default: shape].",
)
@click.option(
    "-o",
    "--output",
    type=FILE,
    metavar="FILE|DIR",
    help="Surface as .obj, .ply, .off, .stl, .glb, or all tets as .msh, .vtu, .vtk, .mesh. In the "
    "format of the first pose's surface (also .gltf), it is that file with new positions. With "
    "--path a folder, a film as .gif or .mp4, or an animated mesh as .glb.",
)
@path_options
@click.option(
    "--linear", is_flag=True, help="Also write the linear blend, as NAME-linear, for comparison."
)
@surface_option
@click.option("--extrapolate", is_flag=True, help="Accept weights outside the sampled simplex.")
@click.option("--png", type=FILE, metavar="FILE", help="Also write a picture of the shapes.")
@up_option
@leading_option
@json_option
def blend(
    model_file: Path,
    weights: list[float] | None,
    frames: int | None,
    even: str | None,
    output: Path | None,
    kind: str | None,
    frames_per_second: float | None,
    linear: bool,
    surface_file: Path | None,
    extrapolate: bool,
    png: Path | None,
    up: str | None,
    dimension: int | None,
    as_json: bool,
) -> None:
    """Blend the poses of a model and write the shapes.

    \b
    Examples:
      snapspace blend lion.snapspace --weights 0.3,0.7 -o out.obj
      snapspace blend centaur.snapspace --path 60 -o frames/ --linear --png path.png
      snapspace blend centaur.snapspace --path 90 -o centaur.mp4

    With --path the largest motion of a vertex is the same from frame to frame, and every pose is a
    frame if there are as many frames as poses. If the shape jumps, however small the step, the
    command reports the frame.
    """
    if png is not None:
        need_extra("pictures", who="--png")
    if (weights is None) == (frames is None):
        raise ValueError("give either --weights or --path")
    if kind is not None and frames is None:
        raise ValueError("--format is for --path; the extension of -o sets the format of one file")
    if frames_per_second is not None and frames is None:
        raise ValueError("--fps is for a film of --path")
    film = frames is not None and is_film(output)
    if linear and film:
        raise ValueError("--linear writes further files; give a folder instead of a film")
    if even is not None and frames is None:
        raise ValueError("--even is for --path; --weights has one shape")
    model = with_surface(load_interpolation(model_file, dimension), surface_file)
    single = None if weights is None else _weights(model, weights, extrapolate=extrapolate)
    _check_outputs(output, png, path=frames is not None)
    if frames is not None:
        check_frames_output(output, kind=kind, frames_per_second=frames_per_second)
    check_own_output(model, output, kind, path=frames is not None)
    if png is None:
        check_up(model, up, output, kind, path=frames is not None)
    session = model.session()
    jumps: list[PathJump] = []
    if single is not None:
        shapes = [shape_at(model, session, single, linear=linear, extrapolate=extrapolate)]
    else:
        assert frames is not None
        shapes, jumps = _path_shapes(model, session, frames, even or "shape", linear=linear)
    _check(model, shapes)
    begin = time.perf_counter()
    if output is not None and film:
        moved = [shape.vertices for shape in shapes]
        rate = frames_per_second or 30.0
        with spinner("writing the frames"):
            written = write_frames(output, model, moved, kind=kind, frames_per_second=rate, up=up)
    else:
        written = _write(model, shapes, output, kind=kind, folder=frames is not None, up=up)
    if png is not None:
        save_png(png, blend_picture(model, shapes, up=up or model.up))
        written.append(png)
    figures = _figures(shapes, written, time.perf_counter() - begin)
    if frames is not None:
        figures["path"] = path_figures(shapes, jumps)
        notice_jumps(jumps)
    _print_report(figures, shell=isinstance(model.problem.mesh, ShellMesh))
    if as_json:
        print_json({"dimension": model.dimension, **figures})


def _weights(
    model: InterpolationModel, numbers: list[float], *, extrapolate: bool
) -> NDArray[np.float64]:
    """The weights (poses,) of a single shape."""
    lowest = model.problem.domain.lowest
    if not extrapolate and min(numbers) < lowest - 1e-9:
        raise ValueError(
            f"{weights_text(np.array(numbers))}: {min(numbers):g} is below {lowest:g}, the "
            "least weight that was sampled; --extrapolate accepts it"
        )
    return model.problem.weights(numbers, extrapolate=extrapolate)


def _path_shapes(
    model: InterpolationModel, session: BlendingSession, frames: int, even: str, *, linear: bool
) -> tuple[list[BlendedShape], list[PathJump]]:
    """The shapes of a path, and its jumps."""
    if even == "weights":
        rows = path_weights(len(model.problem.poses), frames)
        return [shape_at(model, session, w, linear=linear, extrapolate=False) for w in rows], []
    path = even_path(model, session, frames)
    shapes = []
    for frame in path.frames:
        session.put(frame.start_weights, frame.start)
        shapes.append(shape_at(model, session, frame.weights, linear=linear, extrapolate=False))
    return shapes, path.jumps


def _check_outputs(output: Path | None, png: Path | None, *, path: bool) -> None:
    """Raises ValueError unless the files can be written, before any work is done."""
    if png is not None:
        writable_path(png, known=(".png",))
    if output is not None and not path:
        writable_path(output, known=SHAPE_OUTPUTS)


def _write(
    model: InterpolationModel,
    shapes: list[BlendedShape],
    output: Path | None,
    *,
    kind: str | None,
    folder: bool,
    up: str | None,
) -> list[Path]:
    if output is None:
        return []
    suffix = shape_suffix(model, kind)
    if folder:
        notice_old_frames(output, len(shapes), suffix=suffix)
    written = []
    for number, shape in enumerate(shapes):
        path = output / f"frame-{number:04d}{suffix}" if folder else output
        written += write_blended(model, shape, path, up=up)
    return written


def _check(model: InterpolationModel, shapes: list[BlendedShape]) -> None:
    for shape in shapes:
        if shape.report.status == "unbounded":
            raise ValueError(
                f"{weights_text(shape.weights)}: the energy has no minimum that far outside; "
                f"choose weights closer to the poses{certain_share(model, shape.weights)}"
            )
        notice_uncertain(model, shape)
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


def _inverted(frames: list[dict[str, Any]]) -> tuple[str, str]:
    return "inverted tets", f"at most {max(frame['inverted_tets'] for frame in frames)}"


def _print_report(figures: dict[str, Any], *, shell: bool) -> None:
    frames = figures["frames"]
    solve = np.median([frame["solve_ms"] for frame in frames])
    whole = np.median([frame["frame_ms"] for frame in frames])
    converged = sum(frame["status"] == "converged" for frame in frames)
    written = figures["written"]
    more = f" and {len(written) - 1} more" if len(written) > 1 else ""
    facts = [
        ("shapes", f"{len(frames)}, {converged} converged"),
        *path_facts(figures),
        *([] if shell else [_inverted(frames)]),
        ("solve", f"{solve:.2f} ms, with all vertices {whole:.2f} ms"),
        (
            "written",
            f"{written[0]}{more}" if written else "nothing; -o FILE or --png FILE keeps shapes",
        ),
    ]
    print_facts("blended", facts)
