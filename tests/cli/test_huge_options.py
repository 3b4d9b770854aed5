"""Whole numbers too large for any computer are refused by their option, before any work."""

from __future__ import annotations

from pathlib import Path

import click
import pytest

from snapspace.cli.commands import COMMANDS
from snapspace.cli.main import snapspace

from .conftest import Run

HUGE = "1" + "0" * 30


def whole_numbers() -> list[tuple[str, str]]:
    """Every option of the program that takes a whole number."""
    context = click.Context(snapspace)
    commands = [(name, snapspace.get_command(context, name)) for name in COMMANDS]
    return [
        (name, option.opts[-1])
        for name, command in commands
        if command is not None
        for option in command.params
        if isinstance(option, click.Option) and isinstance(option.type, click.types.IntParamType)
    ]


@pytest.mark.parametrize(("command", "option"), whole_numbers())
def test_it_is_refused_in_one_line(run: Run, tmp_path: Path, command: str, option: str) -> None:
    for number in (HUGE, "9" * 5000):
        error = run(command, option, number).error
        assert f"'{option}'" in error
        assert len(error) < 5300


def test_there_are_such_options() -> None:
    """Otherwise the test above would check nothing."""
    found = {option for _, option in whole_numbers()}
    assert {"--samples", "--dimension", "--seed", "--threads", "--max-iterations"} <= found


def test_the_largest_seed_is_accepted(run: Run, built_model: Path) -> None:
    result = run("validate", built_model, "--samples", 2, "--seed", 2**63 - 1)
    assert result.code == 0, result.err
