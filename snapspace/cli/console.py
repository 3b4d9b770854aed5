"""Output: one JSON object on standard output, everything else on standard error."""

from __future__ import annotations

import json
import math
import shlex
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:  # rich is imported only when something is shown
    from rich.console import Console
    from rich.table import Table

from .printable import printable


def console() -> Console:
    """A console on the current standard error."""
    from rich.console import Console

    return Console(stderr=True, highlight=False)


def notice(message: str) -> None:
    """Prints one line on standard error."""
    click.echo(f"snapspace: {one_line(message)}", err=True)


def one_line(message: str) -> str:
    """The message without line breaks, with control characters of terminals escaped."""
    return printable(" ".join(line.strip() for line in message.splitlines() if line.strip()))


def print_json(content: dict[str, Any]) -> None:
    """Prints the result as one JSON object on standard output; non-finite numbers are null."""
    click.echo(json.dumps(_finite(content), indent=2, allow_nan=False))


def print_table(table: Table) -> None:
    """Prints a table on standard error; in a file or pipe without trailing spaces."""
    screen = console()
    if screen.is_terminal:
        screen.print(table)
        return
    with screen.capture() as shown:
        screen.print(table)
    click.echo("\n".join(line.rstrip() for line in shown.get().splitlines()), err=True)


def print_facts(title: str, facts: Iterable[tuple[str, str]]) -> None:
    """Prints a table of names and values on standard error."""
    from rich.table import Table
    from rich.text import Text

    table = Table(show_header=False, box=None, padding=(0, 2, 0, 0))
    table.add_column(style="dim", no_wrap=True)
    table.add_column(overflow="fold")
    for name, value in facts:
        table.add_row(Text(printable(name)), Text(printable(value, keep="\n")))
    console().print(Text(printable(title), style="bold"))
    print_table(table)


def print_next(commands: Iterable[tuple[str, Sequence[str | Path]]]) -> None:
    """Prints suggestions with commands that can be copied; nothing if there are none."""
    given = list(commands)
    if given:
        click.echo("next:", err=True)
    for purpose, words in given:
        click.echo(f"  # {printable(purpose)}", err=True)
        command = shlex.join(["snapspace", *map(str, words)])
        click.echo(f"  {printable(command)}", err=True)


def _finite(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _finite(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_finite(item) for item in value]
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value
