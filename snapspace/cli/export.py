"""`snapspace export`: writes a model as a page, as glTF, or as shape keys for Blender."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from ..page.export import export_html, export_packed
from .console import notice, print_json
from .glb import write_model, write_script
from .loading import load_leading
from .options import FILE, json_option, leading_option, up_option
from .units import in_bytes


@click.command(short_help="Write a model as one HTML page, as glTF, or for Blender.")
@click.argument("model", type=FILE)
@click.option(
    "--html",
    type=FILE,
    metavar="FILE",
    help="The page to write: one file that opens in any browser, without a network.",
)
@click.option(
    "--glb",
    type=FILE,
    metavar="FILE",
    help="The glTF file to write: the surface with the model's modes as morph targets.",
)
@click.option(
    "--blender",
    type=FILE,
    metavar="FILE",
    help="The .py file to write: a script that makes shape keys of the modes in Blender.",
)
@click.option(
    "--packed",
    type=FILE,
    metavar="FILE",
    help="The .snapspace file to write: the part of the model that the web component "
    "<snapspace-viewer> needs.",
)
@click.option(
    "--targets",
    type=click.IntRange(1, 1000),
    metavar="N",
    help="Fit at most N morph targets or shape keys to the training samples, for engines that "
    "support few [default: all modes, which are exact].",
)
@click.option("--title", help="Heading of the page, name of the mesh [default: the model's name].")
@leading_option
@up_option
@json_option
def export(
    model: Path,
    html: Path | None,
    glb: Path | None,
    blender: Path | None,
    packed: Path | None,
    targets: int | None,
    title: str | None,
    dimension: int | None,
    up: str | None,
    as_json: bool,
) -> None:
    """Write a model as one HTML page, to be posed or blended in any browser, or for other programs.

    The page needs no network and no server: mail it, or publish it with a paper. --dimension makes
    it smaller. --packed writes the model alone, for the web component <snapspace-viewer> in your
    own page. The shapes of a glTF file are sums of its morph targets, and --blender makes shape
    keys of the same targets; `snapspace pose --path N -o FILE.glb` writes an animation.

    \b
    Examples:
      snapspace export dragon.snapspace --html dragon.html
      snapspace export dragon.snapspace --glb dragon.glb --targets 8
      snapspace export dragon.snapspace --blender dragon.py
    """
    if html is None and glb is None and blender is None and packed is None:
        raise ValueError("export: nothing to write; give --html, --glb, --blender or --packed FILE")
    if packed is not None and packed.resolve() == model.resolve():
        raise ValueError(f"--packed {packed}: this is the model itself; give another file")
    if targets is not None and glb is None and blender is None:
        raise ValueError("--targets is for glTF and Blender; give --glb or --blender FILE as well")
    loaded = load_leading(model, dimension)
    name = model.stem if title is None else title
    found: dict[str, Any] = {"dimension": loaded.dimension}
    if html is not None:
        export_html(loaded, html, title=name, up=up)
        size = html.stat().st_size
        notice(f"wrote {html}, {in_bytes(size)}; open it in a browser")
        found |= {"file": str(html), "bytes": size}
    if packed is not None:
        export_packed(loaded, packed, title=name, up=up)
        size = packed.stat().st_size
        notice(f"wrote {packed}, {in_bytes(size)}; <snapspace-viewer> shows it")
        found |= {"packed": str(packed), "packed_bytes": size}
    if glb is not None:
        found |= write_model(glb, loaded, targets=targets, name=name, up=up)
    if blender is not None:
        found |= write_script(blender, loaded, targets=targets, name=name, up=up)
    if as_json:
        print_json(found)
