"""The addresses that the wheel workflow writes into pyproject.toml."""

from __future__ import annotations

import configparser
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "tools"))

from project_urls import with_urls  # noqa: E402

HOME = "https://example.org/owner/snapspace"


def urls(text: str) -> dict[str, str]:
    """The section of the addresses, which is also valid INI."""
    section = text.split("[project.urls]", 1)[1].split("\n\n", 1)[0]
    parser = configparser.ConfigParser(delimiters=("=",))
    parser.optionxform = str  # type: ignore[assignment, method-assign]
    parser.read_string("[urls]" + section)
    return {name: value.strip('"') for name, value in parser["urls"].items()}


def test_all_addresses_are_those_of_the_repository() -> None:
    before = (ROOT / "pyproject.toml").read_text("utf-8")
    after = with_urls(before, HOME)
    found = urls(after)
    assert found["Homepage"] == HOME and found["Issues"] == HOME + "/issues"
    assert all(url.startswith(HOME) for url in found.values())
    assert set(after.split("\n")) - set(before.split("\n")) == {
        "[project.urls]",
        *(f'{name} = "{url}"' for name, url in found.items()),
    }


def test_another_repository_replaces_them() -> None:
    before = (ROOT / "pyproject.toml").read_text("utf-8")
    moved = with_urls(with_urls(before, HOME), "https://example.com/a/b.git/")
    assert moved == with_urls(before, "https://example.com/a/b")


@pytest.mark.parametrize(
    "home",
    [
        "",
        "owner/name",
        "http://example.org/a/b",
        "https://example.org",
        'https://example.org/a"b/c',
        "https://example.org/a/b?x=1",
        "https://example.org/a b/c",
    ],
)
def test_anything_else_is_refused(home: str) -> None:
    with pytest.raises(ValueError, match="project_urls"):
        with_urls("[project.scripts]\n", home)
