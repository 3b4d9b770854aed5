"""`snapspace view`: a model in the browser."""

from __future__ import annotations

import os
import sys
import webbrowser
from pathlib import Path

import click

from ..server import serve
from ..server.serve import HOST
from .console import notice
from .loading import load_leading
from .options import FILE, leading_option, up_option


@click.command(short_help="Pose or blend a model in the browser.")
@click.argument("model", type=FILE)
@click.option("--host", default=HOST, show_default=True, help="Address to listen at.")
@click.option(
    "--port",
    type=click.IntRange(0, 65535),
    default=0,
    help="Port to listen at [default: any free one].",
)
@click.option("--no-browser", is_flag=True, help="Only print the address.")
@leading_option
@up_option
def view(
    model: Path, host: str, port: int, no_browser: bool, dimension: int | None, up: str
) -> None:
    """Pose or blend a model in the browser.

    Opens the page, or prints its address where there is no browser; Ctrl-C ends it. Everything is
    solved in the page, so it is as fast through a tunnel: `ssh -L 8000:localhost:8000 ...` and
    `snapspace view MODEL --port 8000` over there.

    \b
    Example:
      snapspace view dragon.snapspace
    """
    loaded = load_leading(model, dimension)

    def ready(address: str) -> None:
        opened = not no_browser and _has_display() and webbrowser.open(address)
        notice(f"{'opened' if opened else 'open'} {address}")
        notice("Ctrl-C ends it")

    serve(loaded, title=model.stem, up=up, host=host, port=port, ready=ready)
    notice("stopped")


def _has_display() -> bool:
    """Whether a browser window could be seen; one in the terminal would not show the page."""
    if sys.platform.startswith("linux"):
        return bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))
    return True
