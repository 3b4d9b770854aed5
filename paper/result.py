"""Result: the rows of a table, printed, and written as JSON."""

from __future__ import annotations

import json
import sys
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from rich.console import Console
from rich.table import Table

from snapspace.disk import atomic_file

FOLDER = Path(__file__).parent / "results"
PICTURES = Path(__file__).parents[1] / "docs" / "pictures" / "paper"


@dataclass
class Result:
    """Rows of figures under one title.

    name : name of the file
    title : printed above the table
    rows : mappings with the same keys
    pictures : (height, width, 3) of shapes, by the names of their files
    """

    name: str
    title: str
    rows: list[dict[str, Any]] = field(default_factory=list)
    pictures: dict[str, NDArray[np.uint8]] = field(default_factory=dict)

    def add(self, **row: Any) -> None:
        """Adds a row, and says so on standard error."""
        self.rows.append(row)
        print(self.name, *(text(value) for value in row.values()), file=sys.stderr, flush=True)

    def print(self) -> None:
        """Prints the table."""
        table = Table(*self.rows[0], title=self.title)
        for row in self.rows:
            table.add_row(*(text(value) for value in row.values()))
        Console(width=190).print(table)

    def save(self, folder: Path = FOLDER) -> Path:
        """Writes NAME.json; the path."""
        folder.mkdir(parents=True, exist_ok=True)
        path = folder / f"{self.name}.json"
        content = {"title": self.title, "rows": self.rows}
        with atomic_file(path) as temporary:
            temporary.write_text(json.dumps(content, indent=1) + "\n", encoding="utf-8")
        return path


def text(value: Any) -> str:
    """A figure as tables show it: three digits, and nothing for None."""
    if value is None:
        return ""
    return f"{value:.3g}" if isinstance(value, float) else str(value)


def slug(name: str) -> str:
    """A name as part of a file name."""
    return name.replace(",", "").replace(" ", "_")
