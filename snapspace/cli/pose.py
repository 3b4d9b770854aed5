"""`snapspace pose`: writes a pose of a model, or a path to it."""

from __future__ import annotations

import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import click
import numpy as np
from numpy.typing import NDArray

from ..animation import write_shape
from ..extras import need_extra
from ..mesh.input_path import writable_path
from ..pictures import render, save_png
from ..problem import PosingProblem
from ..reduction import PosingModel
from ..session import FrameReport
from .console import notice, print_facts, print_json
from .frames import check_frames_output, path_options
from .loading import load_posing
from .motions import MotionCommand, as_parameters, beyond_domain, motions_in_order
from .options import FILE, json_option, leading_option, up_option, vector_option
from .own_surface import (
    SHAPE_OUTPUTS,
    check_own_output,
    check_up,
    surface_option,
    with_surface,
)
from .pose_path import inverted_tets, posed_path
from .progress import spinner
from .write_frames import handle_colors, write_frames


@click.command(cls=MotionCommand, short_help="Move handles and write the shape.")
@click.argument("model_file", type=FILE, metavar="M.snapspace")
@click.option("--handle", multiple=True, metavar="NAME", help="Handle to move; repeat for more.")
@vector_option(
    "--euler",
    "Angles in degrees about the fixed axes x, y, z (in this order).",
)
@vector_option("--translate", "Translation in the mesh's unit of length.")
@click.option(
    "-o",
    "--output",
    type=FILE,
    metavar="FILE",
    help="Surface as .obj, .ply, .off, .stl, .glb, or all tets as .msh, .vtu, .vtk, .mesh. In the "
    "format of the surface that the model was made from (also .gltf), it is that file with new "
    "positions. With --path a folder, a film as .gif or .mp4, or an animated mesh as .glb.",
)
@click.option(
    "--path",
    "frames",
    type=click.IntRange(2, 1_000_000),
    metavar="N",
    help="N shapes on the path from rest to the motions, instead of only the last one.",
)
@path_options
@surface_option
@click.option("--png", type=FILE, metavar="FILE", help="Also write a picture with tinted handles.")
@up_option
@leading_option
@json_option
@click.pass_context
def pose(
    ctx: click.Context,
    /,
    model_file: Path,
    output: Path | None,
    frames: int | None,
    kind: str | None,
    frames_per_second: float | None,
    surface_file: Path | None,
    png: Path | None,
    up: str | None,
    dimension: int | None,
    as_json: bool,
    **_: Any,
) -> None:
    """Move handles and write the shape.

    Motions start at rest and are about the handle's centroid. Each --euler and --translate belongs
    to the --handle before it; handles that are not named stay at rest.

    \b
    Examples:
      snapspace pose dragon.snapspace --handle head --euler 0,0,30 --translate 0,0,1 -o out.obj
      snapspace pose hand.snapspace --handle thumb --euler -20,0,0 --handle index --euler 30,0,0 \\
          -o hand.vtu --png hand.png
      snapspace pose dragon.snapspace --handle head --euler 0,0,30 --path 60 -o nod.mp4

    With --path centroids move in straight lines and handles turn about one axis; the motion starts
    and ends slowly.
    """
    motions = motions_in_order(ctx)
    if frames is None:
        if kind is not None or frames_per_second is not None:
            raise ValueError("--format and --fps are for --path")
        _check_outputs(output, png)
    else:
        check_frames_output(output, kind=kind, frames_per_second=frames_per_second)
        if png is not None:
            raise ValueError("--png is a picture of one shape; with --path give -o FILE.gif")
    model = with_surface(load_posing(model_file, dimension), surface_file)
    check_own_output(model, output, kind, path=frames is not None)
    if png is None:
        check_up(model, up, output, kind, path=frames is not None)
    problem = model.problem
    parameters, carrier = as_parameters(problem, motions)
    if frames is not None:
        path = posed_path(model, motions, frames)
        _check_finite(path.reports)
        _notice_beyond(problem, parameters)
        rate = frames_per_second or 30.0
        with spinner("writing the frames"):
            files = write_frames(
                output, model, path.shapes, kind=kind, frames_per_second=rate, up=up
            )
        path.print_report(files)
        if as_json:
            print_json({"dimension": model.dimension, **path.as_json(files)})
        return
    session = model.session()
    begin = time.perf_counter()
    report = session.pose(parameters)
    vertices = session.vertices @ carrier[:, :3].T + carrier[:, 3]
    frame_ms = 1e3 * (time.perf_counter() - begin)
    _check_finite([report])
    _notice_beyond(problem, parameters)
    if not report.converged:
        notice(f"notice: the solve ended with {report.status}; the shape may be poor")
    figures: dict[str, Any] = {
        "status": report.status,
        "iterations": report.iterations,
        "evaluations": report.evaluations,
        "value": report.value,
        "gradient_norm": report.gradient_norm,
        "solve_ms": 1e3 * report.seconds,
        "frame_ms": frame_ms,
        "inverted_tets": inverted_tets(problem, vertices),
        "dimension": model.dimension,
        "output": None if output is None else str(output),
        "png": None if png is None else str(png),
    }
    if output is not None:
        write_shape(output, model, vertices, up=up)
    if png is not None:
        save_png(png, _picture(model, vertices, up or model.up))
    _print_report(figures)
    if as_json:
        print_json(figures)


def _check_finite(reports: Sequence[FrameReport]) -> None:
    """ValueError if a motion is so large that the energy overflows: then there is no shape."""
    if any(report.status == "not_finite" for report in reports):
        raise ValueError(
            "the motion is so large that the energy is not finite, so there is no shape; give a "
            "smaller --translate"
        )


def _notice_beyond(problem: PosingProblem, parameters: NDArray[np.float64]) -> None:
    first = problem.handles.names[0]
    for name in beyond_domain(problem, parameters):
        notice(
            f"notice: '{name}' moves farther, relative to '{first}', than the samples did; the "
            "shape may be poor"
        )


def _check_outputs(output: Path | None, png: Path | None) -> None:
    """Raises ValueError unless the files can be written, before any work is done."""
    if output is not None:
        writable_path(output, known=SHAPE_OUTPUTS)
    if png is not None:
        writable_path(png, known=(".png",))
        need_extra("pictures", who="--png")


def _picture(model: PosingModel, vertices: NDArray[np.float64], up: str) -> NDArray[np.uint8]:
    surface = model.surface
    return render(surface.vertices(vertices), surface.faces, colors=handle_colors(model), up=up)


def _inverted_fact(count: int | None) -> list[tuple[str, str]]:
    return [] if count is None else [("inverted tets", str(count))]


def _print_report(figures: dict[str, Any]) -> None:
    facts = [
        ("status", f"{figures['status']} after {figures['iterations']} iterations"),
        ("energy", f"{figures['value']:.6g}"),
        *_inverted_fact(figures["inverted_tets"]),
        ("solve", f"{figures['solve_ms']:.2f} ms, with all vertices {figures['frame_ms']:.2f} ms"),
    ]
    written = [name for name in (figures["output"], figures["png"]) if name]
    facts.append(
        ("written", ", ".join(written) or "nothing; -o FILE or --png FILE keeps the shape")
    )
    print_facts("posed", facts)
