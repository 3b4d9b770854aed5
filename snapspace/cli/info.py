"""`snapspace info`: shows what a file contains."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from ..mesh.input_path import existing_file
from ..model_file import SUFFIX
from .console import print_facts, print_json
from .files import SURFACE_INPUTS, TET_INPUTS
from .mesh_info import mesh_info, surface_info
from .model_info import model_info
from .options import FILE, json_option
from .problem_info import problem_file_info

Facts = list[tuple[str, str]]


@click.command(short_help="Show what a file contains.")
@click.argument("file", type=FILE)
@json_option
def info(file: Path, as_json: bool) -> None:
    """Show what a model, a mesh, a surface or a problem file contains.

    For an invalid tet mesh it says why, and what `build --repair` would do.

    \b
    Examples:
      snapspace info dragon.snapspace
      snapspace info dragon.mesh --json
    """
    existing_file(file, known=(SUFFIX, ".json", *TET_INPUTS, *SURFACE_INPUTS))
    figures, facts = _describe(file)
    print_facts(f"{file}: {figures['kind']}", facts)
    if as_json:
        print_json({"file": str(file), **figures})


def _describe(file: Path) -> tuple[dict[str, Any], Facts]:
    suffix = file.suffix.lower()
    if suffix == SUFFIX:
        return model_info(file)
    if suffix == ".json":
        return problem_file_info(file)
    if suffix in SURFACE_INPUTS:
        return surface_info(file)
    return mesh_info(file)
