"""Options that several commands share, and the values that they accept."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, TypeVar

import click

Command = TypeVar("Command", bound=Callable[..., Any])
Vector = tuple[float, float, float]

FILE = click.Path(path_type=Path)
# Whole numbers, with limits far above any use: larger ones do not fit in the core's integers, or in
# any memory.
SAMPLE_COUNT = click.IntRange(1, 1_000_000)
MODE_COUNT = click.IntRange(1, 10_000)
TET_COUNT = click.IntRange(1, 2**31 - 1)
ITERATION_COUNT = click.IntRange(1, 2**31 - 1)
THREAD_COUNT = click.IntRange(1, 1024)
# Shares, such as errors relative to a displacement; values of one or more would mean nothing.
SHARE = click.FloatRange(0, 1, min_open=True, max_open=True)
SHARE_OR_NONE = click.FloatRange(0, 1, max_open=True)
SEED_NUMBER = click.IntRange(0, 2**63 - 1)


def parse_numbers(text: str, *, example: str = "numbers such as 0.2,0.8") -> list[float]:
    """Finite numbers with commas or spaces between them, such as 0.2,0.8; else ValueError."""
    words = text.split(",") if "," in text else text.split()
    try:
        numbers = [float(word) for word in words]
    except ValueError:
        raise ValueError(f"'{text}' is not {example}") from None
    if not numbers:
        raise ValueError(f"'{text}' is not {example}")
    if not all(math.isfinite(number) for number in numbers):
        raise ValueError(f"'{text}' is not finite")
    return numbers


def parse_vector(text: str) -> Vector:
    """Three finite numbers with commas or spaces between them, such as -10,0,0; else ValueError."""
    numbers = parse_numbers(text, example="three numbers such as 0,0,30")
    if len(numbers) != 3:
        raise ValueError(f"'{text}' has {len(numbers)} of three numbers, such as 0,0,30")
    return numbers[0], numbers[1], numbers[2]


def vector_option(name: str, text: str) -> Callable[[Command], Command]:
    """An option that may be repeated, whose values are vectors."""

    def parse(ctx: click.Context, option: click.Parameter, values: Sequence[str]) -> list[Vector]:
        try:
            return [parse_vector(value) for value in values]
        except ValueError as error:
            raise click.BadParameter(str(error), ctx, option) from None

    return click.option(name, multiple=True, metavar="X,Y,Z", callback=parse, help=text)


def numbers_option(name: str, *, metavar: str, text: str) -> Callable[[Command], Command]:
    """An option whose value is a list of finite numbers, None if it is not given."""

    def parse(ctx: click.Context, option: click.Parameter, value: str | None) -> list[float] | None:
        try:
            return None if value is None else parse_numbers(value)
        except ValueError as error:
            raise click.BadParameter(str(error), ctx, option) from None

    return click.option(name, metavar=metavar, callback=parse, help=text)


def json_option(command: Command) -> Command:
    """Adds --json, as the parameter as_json."""
    return click.option(
        "--json",
        "as_json",
        is_flag=True,
        help="Print the result as one JSON object on standard output.",
    )(command)


def threads_option(command: Command) -> Command:
    """Adds --threads, None for all."""
    return click.option(
        "--threads",
        type=THREAD_COUNT,
        metavar="N",
        help="Number of threads [default: all]. The result does not depend on it.",
    )(command)


def dask_option(command: Command) -> Command:
    """Adds --dask, None for this machine."""
    return click.option(
        "--dask",
        metavar="ADDRESS",
        help="Solve the samples on the dask cluster with this scheduler, such as "
        "tcp://127.0.0.1:8786. The result is the same.",
    )(command)


def leading_option(command: Command) -> Command:
    """Adds --dimension for an existing model."""
    return click.option(
        "--dimension",
        type=MODE_COUNT,
        metavar="D",
        help="Use only the first D modes of the model [default: all].",
    )(command)


def up_option(command: Command) -> Command:
    """Adds --up for pictures."""
    return click.option(
        "--up",
        type=click.Choice(["x", "y", "z"]),
        help="Axis that points up; coordinates do not change [default: that of the model or "
        "problem, else y for .obj, .glb and .gltf, z for others].",
    )(command)


def shell_option(command: Command) -> Command:
    """Adds --shell, the thickness of a surface that is not filled."""
    return click.option(
        "--shell",
        "thickness",
        type=click.FloatRange(min=0, min_open=True),
        metavar="THICKNESS",
        help="Treat a surface as a thin shell of this thickness, in its unit of length, instead of "
        "filling it. It may be open. The thickness is only a factor with the default material, "
        "arap, which is as rigid as possible; with others it determines the bending.",
    )(command)
