"""given_options: the options on the command line, for the record in a model."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click
from click.core import ParameterSource

#: Options that say where and how to work, but not what to build.
_HOW = {"--threads", "--dask", "--json"}


def given_options() -> dict[str, Any]:
    """Options on the command line with their values, without files and folders.

    Together with the names of the files they reproduce the model. A flag has the value true.
    """
    given: dict[str, Any] = {}
    for option in chosen_parameters():
        value, word = click.get_current_context().params.get(option.name or ""), option.opts[-1]
        if isinstance(option, click.Option) and word not in _HOW and not isinstance(value, Path):
            given[word] = value
    return given


def chosen_parameters() -> list[click.Parameter]:
    """Options and arguments of the running command that the user gave."""
    context = click.get_current_context()
    return [
        parameter
        for parameter in context.command.params
        if context.get_parameter_source(parameter.name or "") is ParameterSource.COMMANDLINE
    ]


def as_words(options: dict[str, Any]) -> list[str]:
    """The options as words of a command line."""
    words: list[str] = []
    for name, value in options.items():
        words += [name] if value is True else [name, str(value)]
    return words
