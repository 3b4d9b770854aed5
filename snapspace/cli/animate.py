"""`snapspace animate`: solves a timeline and writes its frames."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any

import click
import numpy as np

from ..problem.json_entries import within
from ..reduction import InterpolationModel, PosingModel
from ..timeline import Timeline, read_timeline, timeline_of
from .console import notice, print_facts, print_json
from .frames import check_frames_output, frame_options, is_film
from .loading import load_leading
from .options import FILE, json_option, leading_option, up_option
from .own_surface import check_own_output, check_up, surface_option, with_surface
from .progress import spinner
from .write_frames import write_frames


@click.command(short_help="Solve a timeline and write its frames.")
@click.argument("model_file", type=FILE, metavar="M.snapspace")
@click.argument("timeline_file", type=FILE, metavar="[TIMELINE.json]", required=False)
@click.option(
    "-o",
    "--output",
    type=FILE,
    metavar="DIR|FILE",
    help="A folder for numbered files, a film as .gif or .mp4, or an animated mesh as .glb.",
)
@frame_options(files="the folder", rate="the timeline")
@surface_option
@up_option
@leading_option
@json_option
def animate(
    model_file: Path,
    timeline_file: Path | None,
    output: Path | None,
    kind: str | None,
    frames_per_second: float | None,
    surface_file: Path | None,
    up: str | None,
    dimension: int | None,
    as_json: bool,
) -> None:
    """Solve a timeline, as the page saves it, and write its frames.

    Without a file, the timeline is the one that was saved with the model. Every frame is solved;
    shapes are not interpolated. In a folder, --format vtu also writes
    frames.vtu.series, which ParaView opens with the times.

    \b
    Examples:
      snapspace animate creature.snapspace wave.json -o wave.glb
      snapspace animate creature.snapspace wave.json -o frames --format vtu
    """
    given = None if timeline_file is None else read_timeline(timeline_file)
    film = is_film(output)
    check_frames_output(output, kind=kind, frames_per_second=frames_per_second if film else None)
    loaded: Any = load_leading(model_file, dimension)
    model: PosingModel | InterpolationModel = with_surface(loaded, surface_file)
    check_own_output(model, output, kind, path=True)
    check_up(model, up, output, kind, path=True)
    rate = frames_per_second or 30.0
    timeline = _own_timeline(model, model_file) if given is None else given
    session = model.session()
    count = timeline.frame_count(rate)
    begin = time.perf_counter()
    shapes, reports = [], []
    with within(timeline_file or model_file):
        for report in session.animate(timeline, frames=count):
            reports.append(report)
            shapes.append(session.vertices)
    seconds = time.perf_counter() - begin
    failed = [report for report in reports if not report.converged]
    if failed:
        notice(
            f"notice: {len(failed)} of {count} solves ended with {failed[0].status}; those shapes "
            "may be poor"
        )
    with spinner("writing the frames"):
        files = write_frames(output, model, shapes, kind=kind, frames_per_second=rate, up=up)
    solve = 1e3 * float(np.median([report.seconds for report in reports]))
    facts = [
        ("timeline", f"{len(timeline.keys)} keys, {timeline.duration:g} s"),
        ("frames", f"{count} at {rate:g} a second, {count - len(failed)} converged"),
        ("solve", f"{solve:.2f} ms"),
        ("written", _written(files)),
    ]
    print_facts("animated", facts)
    if as_json:
        print_json(
            {
                "keys": len(timeline.keys),
                "frames": count,
                "converged": count - len(failed),
                "solve_ms": solve,
                "seconds": seconds,
                "written": [str(file) for file in files],
            }
        )


def _own_timeline(model: PosingModel | InterpolationModel, path: Path) -> Timeline:
    content = model.provenance.get("timeline")
    if content is None:
        raise ValueError(f"{path}: the model has no timeline; name a file, as the page saves it")
    with within(path):
        return timeline_of(content)


def _written(files: list[Path]) -> str:
    if not files:
        return "nothing; -o DIR or -o FILE.glb keeps the frames"
    more = f" and {len(files) - 1} more" if len(files) > 1 else ""
    return f"{files[0]}{more}"
