"""The material of `interpolate`, from its options."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

import click

from ..material import (
    ARAP,
    BLEND_RADIUS,
    DEFAULT_MATERIAL,
    MATERIALS,
    Material,
    ShearMaterial,
    default_material,
    material_class,
)
from .given_options import chosen_parameters
from .shell_pose_files import check_shell_options

Command = TypeVar("Command", bound=Callable[..., Any])

_OPTIONS = (
    click.option(
        "--material",
        "kind",
        type=click.Choice(sorted(MATERIALS)),
        help=f"Material of the body; stvk is the paper's [default: {DEFAULT_MATERIAL.kind}, or "
        f"{ARAP.kind} with --shell].",
    ),
    click.option("--lam", type=float, default=1.0, show_default=True, help="First Lame parameter."),
    click.option("--mu", type=float, default=1.0, show_default=True, help="Second Lame parameter."),
    click.option(
        "--radius",
        type=float,
        metavar="SHARE",
        help=f"With --shell and {ARAP.kind}: radius of the neighbourhoods that are rigid, relative "
        "to the diagonal. Smaller parts are blended linearly; 0 are the triangles around each "
        f"vertex, which bend more easily the finer a surface is [default: {BLEND_RADIUS}].",
    ),
)


def material_options(command: Command) -> Command:
    """Adds the options of the material to a command."""
    for option in reversed(_OPTIONS):
        command = option(command)
    return command


def blend_material(
    kind: str | None, *, lam: float, mu: float, radius: float | None, shell: bool
) -> Material:
    """The material of these options, checked against `--shell`.

    Raises
    ------
    ValueError
        For a material that has no form for shells, options on the command line that contradict
        `--shell`, or a radius or first Lame parameter for a material that has none.
    """
    chosen = kind or default_material(surface=shell, blended=True).kind
    made_of = material_class(chosen)
    if issubclass(made_of, ShearMaterial) and "lam" in {one.name for one in chosen_parameters()}:
        raise ValueError(
            f"--lam is for materials with a first Lame parameter, but {chosen} has none; leave it "
            "out"
        )
    if shell:
        check_shell_options(chosen)
    rigid = shell and chosen == ARAP.kind
    if radius is not None and not rigid:
        raise ValueError(
            f"--radius is for surfaces that are as rigid as possible; give --shell and "
            f"--material {ARAP.kind} as well, or leave it out"
        )
    if rigid:
        return ARAP(mu=mu, radius=BLEND_RADIUS if radius is None else radius)
    return made_of.from_lame(lam=lam, mu=mu)
