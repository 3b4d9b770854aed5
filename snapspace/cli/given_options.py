"""given_options: what the user chose on the command line, for the record in a model."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click
from click.core import ParameterSource

#: Options that say where and how to work, and not what to build.
_HOW = {"--threads", "--dask", "--json"}


def given_options() -> dict[str, Any]:
    """Options of the running command with their values, without files and folders.

    With the names of the files they make the same model again; a flag has the value true.
    """
    context = click.get_current_context()
    given: dict[str, Any] = {}
    for option in context.command.params:
        name = option.name or ""
        if not isinstance(option, click.Option):
            continue
        if context.get_parameter_source(name) is not ParameterSource.COMMANDLINE:
            continue
        value, word = context.params.get(name), option.opts[-1]
        if word not in _HOW and not isinstance(value, Path):
            given[word] = value
    return given


def as_words(options: dict[str, Any]) -> list[str]:
    """The options as words of a command line."""
    words: list[str] = []
    for name, value in options.items():
        words += [name] if value is True else [name, str(value)]
    return words
