"""`import snapspace` and the program's help are quick, and no name is lost by that."""

from __future__ import annotations

import ast
import subprocess
import sys
from pathlib import Path

import pytest

import snapspace
from snapspace.cli.commands import COMMANDS
from snapspace.cli.main import snapspace as program

STUB = Path(snapspace.__file__ or "").with_suffix(".pyi")


def processor_seconds(*words: str) -> float:
    """Processor seconds of a Python process: the least of three, since other processes only add."""
    resource = pytest.importorskip("resource", reason="Windows does not report them")
    seconds = []
    for _ in range(3):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run([sys.executable, *words], check=True, stdout=subprocess.DEVNULL)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        seconds.append(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)
    return min(seconds)


def test_import_takes_a_quarter_of_a_second_at_most() -> None:
    assert processor_seconds("-c", "import snapspace") <= 0.25


def test_help_takes_three_tenths_of_a_second_at_most() -> None:
    assert processor_seconds("-m", "snapspace", "--help") <= 0.3


def test_type_checkers_see_the_exported_names() -> None:
    tree = ast.parse(STUB.read_text(encoding="utf-8"))
    typed = {
        node.module: tuple(alias.name for alias in node.names)
        for node in tree.body
        if isinstance(node, ast.ImportFrom)
    }
    assert typed == snapspace.EXPORTS
    assert sorted(name for names in typed.values() for name in names) == snapspace.__all__


def test_every_name_comes_from_its_package() -> None:
    for home, names in snapspace.EXPORTS.items():
        module = getattr(snapspace, home)
        assert module.__name__ == f"snapspace.{home}"
        for name in names:
            assert getattr(snapspace, name) is getattr(module, name)


def test_a_name_that_does_not_exist_is_an_attribute_error() -> None:
    with pytest.raises(AttributeError, match="module 'snapspace' has no attribute 'tetmesh'"):
        snapspace.tetmesh  # type: ignore[attr-defined]  # noqa: B018
    assert {"TetMesh", "mesh", "__version__"} <= set(dir(snapspace))


@pytest.mark.parametrize("name", COMMANDS)
def test_the_help_lists_commands_with_their_own_short_help(name: str) -> None:
    context = program.make_context("snapspace", [name])
    command = program.get_command(context, name)
    assert command is not None and command.name == name
    assert command.short_help == COMMANDS[name]
