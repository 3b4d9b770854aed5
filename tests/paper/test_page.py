"""The tables of the docs page are those of the results."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from paper.page import PAGE, with_tables
from paper.result import FOLDER, Result

TEXT = "Before\n\n<!-- one -->\nold\n<!-- end of one -->\n\nAfter\n"


def test_a_table_has_the_rows(tmp_path: Path) -> None:
    rows = [
        {"shape": "a|b", "d": 3, "error": 0.012345, "paper": None},
        {"shape": "c", "d": 4, "error": None, "paper": None},
    ]
    (tmp_path / "one.json").write_text(json.dumps({"title": "One", "rows": rows}))
    page = with_tables(TEXT, tmp_path)
    assert (
        "| shape | d | error |\n| --- | --- | --- |\n| a\\|b | 3 | 0.0123 |\n| c | 4 |  |" in page
    )
    assert page.startswith("Before\n") and page.endswith("After\n") and "old" not in page
    assert with_tables(page, tmp_path) == page


def test_a_marker_may_choose_rows(tmp_path: Path) -> None:
    rows = [{"shape": shape, "d": d, "error": 0.5} for shape in ("a", "b") for d in (3, 4)]
    (tmp_path / "one.json").write_text(json.dumps({"title": "One", "rows": rows}))
    text = TEXT.replace("<!-- one -->", "<!-- one shape=b d=4 -->")
    page = with_tables(text, tmp_path)
    assert "<!-- one shape=b d=4 -->\n\n| error |\n| --- |\n| 0.5 |\n\n<!-- end" in page
    with pytest.raises(ValueError, match="has no rows with shape=c"):
        with_tables(TEXT.replace("<!-- one -->", "<!-- one shape=c -->"), tmp_path)


def test_a_missing_result_is_named(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"one\.json is missing; run `python -m paper one`"):
        with_tables(TEXT, tmp_path)


def test_the_page_is_up_to_date() -> None:
    text = PAGE.read_text("utf-8")
    assert with_tables(text, FOLDER) == text, "run python -m paper.page"


def test_results_are_saved_whole(tmp_path: Path) -> None:
    result = Result("one", "One")
    result.add(shape="bar", error=0.25, paper=None)
    path = result.save(tmp_path / "new")
    content = json.loads(path.read_text("utf-8"))
    assert content == {"title": "One", "rows": [{"shape": "bar", "error": 0.25, "paper": None}]}
    assert [file.name for file in path.parent.iterdir()] == ["one.json"]
