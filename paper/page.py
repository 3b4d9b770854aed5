"""Writes the tables of docs/comparison.md from paper/results/*.json: `python -m paper.page`.

A table stands between `<!-- NAME -->` and `<!-- end of NAME -->`; NAME.json has its rows. The first
marker may choose rows, as `<!-- NAME shape=dragon d=40 -->`; then these columns are left out. With
`--check`, nothing is written, and the exit code is 1 if the page has other figures.
"""

from __future__ import annotations

import argparse
import json
import re
import sys
from pathlib import Path
from typing import Any

from snapspace.disk import atomic_file

from .result import FOLDER, text

PAGE = Path(__file__).parents[1] / "docs" / "comparison.md"


def with_tables(text: str, folder: Path) -> str:
    """The page with the tables of a folder of results; ValueError if one is missing."""

    def filled(match: re.Match[str]) -> str:
        path = folder / f"{match[1]}.json"
        if not path.is_file():
            raise ValueError(f"page: {path} is missing; run `python -m paper {match[1]}`")
        rows = json.loads(path.read_text("utf-8"))["rows"]
        wanted = dict(pair.split("=", 1) for pair in match[2].split())
        chosen = [
            {name: value for name, value in row.items() if name not in wanted}
            for row in rows
            if all(str(row[name]) == value for name, value in wanted.items())
        ]
        if not chosen:
            raise ValueError(f"page: {path} has no rows with {match[2].strip()}")
        marker = f"<!-- {match[1]}{match[2]} -->"
        return f"{marker}\n\n{markdown(chosen)}\n\n<!-- end of {match[1]} -->"

    pattern = r"<!-- (\w+)((?: [\w-]+=[\w-]+)*) -->\n.*?<!-- end of \1 -->"
    return re.sub(pattern, filled, text, flags=re.DOTALL)


def markdown(rows: list[dict[str, Any]]) -> str:
    """A table with a line for each row; columns that are always empty are left out."""
    names = [name for name in rows[0] if any(row[name] is not None for row in rows)]
    lines = [names, ["---"] * len(names)]
    lines += [[text(row[name]).replace("|", "\\|") for name in names] for row in rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def main() -> int:
    parser = argparse.ArgumentParser(prog="python -m paper.page", description=__doc__)
    parser.add_argument("--check", action="store_true", help="write nothing; fail if it differs")
    check = parser.parse_args().check
    before = PAGE.read_text("utf-8")
    try:
        after = with_tables(before, FOLDER)
    except ValueError as error:
        print(error, file=sys.stderr)
        return 2
    if check:
        return 0 if before == after else 1
    with atomic_file(PAGE) as temporary:
        temporary.write_text(after, "utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
