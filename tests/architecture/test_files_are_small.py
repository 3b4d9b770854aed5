"""One idea per file, readable in one sitting."""

from __future__ import annotations

from pathlib import Path

ROOT = Path(__file__).parents[2]
LONGEST = 300


def sources() -> list[Path]:
    folders = [ROOT / name for name in ("snapspace", "core", "tests", "tools", "paper", "fuzz")]
    folders += [ROOT / "web" / name for name in ("engine", "render", "ui", "viewer")]
    files = [path for folder in folders for path in folder.rglob("*.*")]
    found = {path for path in files if path.suffix in {".py", ".h", ".cpp", ".ts", ".css"}}
    return sorted(found)


def test_no_file_is_long() -> None:
    """The message lists all long files: split them by ideas."""
    lengths = {
        str(path.relative_to(ROOT)): len(path.read_text(encoding="utf-8").splitlines())
        for path in sources()
    }
    assert {name: length for name, length in lengths.items() if length > LONGEST} == {}


def test_there_are_files_to_check() -> None:
    """Where the sources do not lie beside the tests, the test above would check nothing."""
    assert len(sources()) > 100
