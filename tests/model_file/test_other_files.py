"""Files that are no model files: the message says what they are."""

from __future__ import annotations

from pathlib import Path

import pytest

from snapspace import load

from .test_bad_files import refused


@pytest.mark.parametrize(
    ("name", "kind"),
    [
        ("creature.obj", "a surface"),
        ("creature.msh", "a tet mesh"),
        ("creature.json", "a problem or timeline"),
        ("creature.html", "a page"),
        ("creature.pdf", "a file of another kind"),
    ],
)
def test_a_file_of_another_kind_is_called_what_it_is(tmp_path: Path, name: str, kind: str) -> None:
    path = tmp_path / name
    path.write_text("some text that is longer than the eight bytes of a header's length")
    message = refused(path)
    assert message.startswith(f"{path}: this is {kind}, but a model (.snapspace) is needed")


def test_a_model_is_read_whatever_its_name(saved: Path) -> None:
    assert load(saved.rename(saved.with_name("model.backup"))).dimension == 5


def test_messages_say_nothing_about_parts_of_the_container(saved: Path) -> None:
    saved.write_bytes(b"some text that is longer than the header's length")
    assert refused(saved) == f"{saved}: not a complete snapspace model; copy or build it again"
