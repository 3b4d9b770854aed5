"""A command shows the same notice once, for example if a surface is mended for two fillers."""

from __future__ import annotations

import pytest

from snapspace.cli.main import _notices
from snapspace.mesh import MeshNotice
from snapspace.notice import notify


def test_the_same_notice_is_shown_once_by_a_command(capsys: pytest.CaptureFixture[str]) -> None:
    for _ in range(2):  # two commands
        with _notices():
            for text in ("the surface was mended", "the surface was mended", "it has small parts"):
                notify(text, MeshNotice)
    told = capsys.readouterr().err
    assert told.count("the surface was mended") == 2 and told.count("it has small parts") == 2
