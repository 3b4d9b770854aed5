"""Names from files and users are shown without any effect on the terminal."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from snapspace import Handles, load
from snapspace.cli.printable import printable

from .conftest import Run

#: Sets the title, hides text, moves up a line, reverses text; ends with a one-byte CSI.
EVIL = "he\x1b]0;owned\x07ad\x1b[8m\x1b[A\u202egnp\x9b31m\r"
SHOWN = r"he\x1b]0;owned\x07ad\x1b[8m\x1b[A\u202egnp\x9b31m"


def test_only_what_a_terminal_acts_on_is_escaped() -> None:
    assert printable(EVIL) == SHOWN + r"\r"
    assert printable("a\ud800b\u2028c\x7f") == r"a\ud800b\u2028c\x7f"
    for harmless in ("Löwe, 狮子 — ±45°", "a [bold]b", "two\\n", ""):
        assert printable(harmless) == harmless
    assert printable("a\nb\x1b", keep="\n") == "a\nb\\x1b"


@pytest.fixture
def named(model: Path) -> Path:
    """A model whose moving handle has such a name."""
    loaded = load(model)
    handles = Handles([handle.vertices for handle in loaded.problem.handles], names=["left", EVIL])
    problem = loaded.problem.with_handles(handles, domain=loaded.problem.domain)
    return replace(loaded, problem=problem).save(model)


def test_names_in_a_model_are_shown_with_escapes(run: Run, named: Path) -> None:
    shown = run("info", named)
    assert shown.code == 0 and SHOWN in shown.err.replace("\n", "")
    refused = run("pose", named, "--handle", "he\x1b[2J", "-o", named.with_suffix(".obj"))
    assert r"he\x1b[2J" in refused.error and SHOWN in refused.error
    for text in (shown.err, refused.err):
        assert not set(text) & set("\x1b\x07\x9b\r\u202e")


def test_names_of_files_are_shown_with_escapes(run: Run, tmp_path: Path) -> None:
    refused = run("info", tmp_path / "a\x1b[31mb.mesh")
    assert r"a\x1b[31mb.mesh" in refused.error and "\x1b" not in refused.err
