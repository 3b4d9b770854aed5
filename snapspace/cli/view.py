"""`snapspace view`: shows a model in the browser, or a mesh to choose handles on."""

from __future__ import annotations

import os
import sys
import webbrowser
from pathlib import Path

import click

from ..extras import need_extra
from ..filling import SurfaceFilling
from ..mesh import SURFACE_SUFFIXES, TET_SUFFIXES
from ..mesh.input_path import existing_file
from ..model_file import SUFFIX
from ..problem import problem_surface_file, problem_thickness
from ..server import (
    MESH_SUFFIXES,
    PROBLEM_SUFFIX,
    SharedBody,
    mesh_body,
    problem_body,
    read_mesh,
    serve,
)
from ..server.serve import HOST
from ..server.settings import UPLOAD_LIMIT
from .console import notice
from .filling_options import check_installed, check_unfilled, filling_options
from .loading import load_leading
from .options import FILE, leading_option, shell_option, up_option


@click.command(short_help="Pose or blend in the browser, or choose handles there.")
@click.argument("file", type=FILE, required=False)
@click.option("--host", default=HOST, show_default=True, help="Address to listen on.")
@click.option(
    "--port",
    type=click.IntRange(0, 65535),
    default=0,
    help="Port to listen on [default: any free one].",
)
@click.option("--no-browser", is_flag=True, help="Only print the address.")
@click.option(
    "--upload-limit",
    type=click.FloatRange(min=0, min_open=True),
    default=UPLOAD_LIMIT / 2**20,
    show_default=True,
    metavar="MB",
    help="Largest size of a mesh that is dropped on the page.",
)
@shell_option
@filling_options
@leading_option
@up_option
def view(
    file: Path | None,
    host: str,
    port: int,
    no_browser: bool,
    upload_limit: float,
    thickness: float | None,
    edge_length: float | None,
    exact: bool,
    dimension: int | None,
    up: str | None,
) -> None:
    """Pose or blend a model in the browser, or make one there.

    FILE is a model, or a problem, tets or a surface on which you choose handles and compute models.
    Without FILE, drop a mesh on the page. A closed surface is first filled with tets, in seconds;
    if it is too thin for quick tets, fTetWild fills it, which takes up to a few minutes. An open
    surface is a shell: it stays as it is, unless it is a body with open parts such as cloth. In the
    page you can switch between the two; --shell makes any surface a shell, --edge-length and
    --exact fill any surface.

    The command opens the page, or prints its address if there is no browser; Ctrl-C ends it. Shapes
    are solved in the page, so it is as fast through a tunnel: `ssh -L 8000:localhost:8000 ...` on
    this machine and `snapspace view FILE --port 8000` on the other one. With `--host 0.0.0.0` other
    machines can open the page if they know the whole address.

    \b
    Examples:
      snapspace view dragon.snapspace
      snapspace view dragon.json
      snapspace view bunny.obj
      snapspace view leaf.obj --shell 0.01
    """
    need_extra("view", who="snapspace view")
    model = body = None
    filling = None
    if edge_length is not None or exact:
        filling = SurfaceFilling(edge_length=edge_length, exact=exact)
    if file is not None:
        existing_file(file, known=(SUFFIX, PROBLEM_SUFFIX, *MESH_SUFFIXES))
    _check_surface_options(file, filling, thickness)
    if filling is not None:
        check_installed(filling)
    if file is not None:
        if file.suffix.lower() == SUFFIX:
            model = load_leading(file, dimension)
        else:
            body = _body(file, filling, thickness)
    if model is None and dimension is not None:
        raise ValueError("--dimension is for models; the page asks for it before it computes")

    def ready(address: str) -> None:
        opened = not no_browser and _has_display() and webbrowser.open(address)
        notice(f"{'opened' if opened else 'open'} {address}")
        notice("Ctrl-C ends it")

    serve(
        model,
        body=body,
        title="Snapspace" if file is None else file.stem,
        up=up,
        folder=Path() if file is None else file.parent,
        upload_limit=int(upload_limit * 2**20),
        filling=filling,
        host=host,
        port=port,
        ready=ready,
    )
    notice("stopped")


def _check_surface_options(
    file: Path | None, filling: SurfaceFilling | None, thickness: float | None
) -> None:
    """ValueError for options that say how a surface becomes a body, if FILE does not need them."""
    suffix = "" if file is None else file.suffix.lower()
    if thickness is not None and file is None:
        raise ValueError("--shell is for a surface as FILE; the page has the same choice as Body")
    if thickness is not None and suffix not in SURFACE_SUFFIXES:
        raise ValueError(f"{file}: --shell is for surfaces; a problem file says its own thickness")
    if file is None or filling is None:
        return  # without FILE they are for a mesh that is dropped on the page
    is_problem = suffix == PROBLEM_SUFFIX
    if thickness is not None or (is_problem and problem_thickness(file) is not None):
        check_unfilled(filling, "a shell is not filled")
    if suffix == SUFFIX:
        check_unfilled(filling, f"{file} is a model")
    if suffix in TET_SUFFIXES or (is_problem and problem_surface_file(file) is None):
        check_unfilled(filling, f"{file} has tets already")


def _body(file: Path, filling: SurfaceFilling | None, thickness: float | None) -> SharedBody:
    """The body that the page starts with. Its file is read now, so that errors appear here."""
    suffix = file.suffix.lower()
    if suffix == PROBLEM_SUFFIX:
        body = problem_body(file, filling=filling)
    elif suffix in TET_SUFFIXES:
        body = mesh_body(file, stage=lambda stage: None)
    else:
        return SharedBody(read_mesh(file, filling=filling, thickness=thickness))
    return SharedBody(lambda _: body)


def _has_display() -> bool:
    """Whether a browser window can be shown; a terminal browser could not show the page."""
    if sys.platform.startswith("linux"):
        return bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))
    return True
