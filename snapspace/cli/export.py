"""`snapspace export`: writes a model as a page that can be mailed."""

from __future__ import annotations

from pathlib import Path

import click

from ..page.export import export_html
from .console import notice, print_json
from .loading import load_leading
from .options import FILE, json_option, leading_option, up_option
from .units import in_bytes


@click.command(short_help="Write a model as one HTML page.")
@click.argument("model", type=FILE)
@click.option(
    "--html",
    type=FILE,
    required=True,
    metavar="FILE",
    help="The page to write: one file that opens in any browser, without a network.",
)
@click.option("--title", help="Heading of the page [default: the model's name].")
@leading_option
@up_option
@json_option
def export(
    model: Path, html: Path, title: str | None, dimension: int | None, up: str | None, as_json: bool
) -> None:
    """Write a model as one HTML page, to be posed or blended in any browser.

    The file needs no network and no server: mail it, or publish it with a paper. --dimension makes
    it smaller.

    \b
    Example:
      snapspace export dragon.snapspace --html dragon.html
    """
    loaded = load_leading(model, dimension)
    export_html(loaded, html, title=model.stem if title is None else title, up=up)
    size = html.stat().st_size
    notice(f"wrote {html}, {in_bytes(size)}; open it in a browser")
    if as_json:
        print_json({"file": str(html), "bytes": size, "dimension": loaded.dimension})
