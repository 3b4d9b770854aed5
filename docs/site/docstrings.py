"""Docstrings as they are written here, for reStructuredText.

A bar is part of a norm, a trailing underscore is not a link, and consecutive lines of the form
`name : what it is` are a list.
"""

from __future__ import annotations

import re
from typing import Any

from sphinx.application import Sphinx

_LITERAL = re.compile(r"(``.*?``|`[^`]*`)")
_ENTRY = re.compile(r"^(\w+(?:, \w+)*) : (.*)$")


def _escaped(line: str) -> str:
    parts = _LITERAL.split(line)
    parts[::2] = [re.sub(r"([|*]|_\b(?!\w))", r"\\\1", part) for part in parts[::2]]
    return "".join(parts)


def _entries(lines: list[str]) -> list[str]:
    """Entries as a list, up to the first section: napoleon handles sections."""
    sections = [i - 1 for i, line in enumerate(lines) if re.fullmatch(r"-{3,}", line)]
    end = sections[0] if sections else len(lines)
    result: list[str] = []
    inside = False
    for line in lines[:end]:
        found = _ENTRY.match(line)
        if found:
            result += [] if inside or not result or not result[-1] else [""]
            result.append(f"- ``{found[1]}``: {found[2]}")
            inside = True
        else:
            inside = inside and bool(line)
            result.append(f"  {line.strip()}" if inside else line)
    return result + lines[end:]


def _examples(lines: list[str]) -> list[str]:
    """Marks the text below the title Examples as code."""
    for i in range(1, len(lines)):
        if re.fullmatch(r"-{3,}", lines[i]) and lines[i - 1] == "Examples":
            code = [f"    {line}" if line else line for line in lines[i + 1 :]]
            return [*lines[: i + 1], ".. code-block:: python", "", *code]
    return lines


def _process(app: Sphinx, what: str, name: str, obj: Any, options: Any, lines: list[str]) -> None:
    examples = lines.index("Examples") if "Examples" in lines else len(lines)
    text = [_escaped(line) for line in lines[:examples]]
    lines[:] = _examples([*_entries(text), *lines[examples:]])


def _process_help(app: Sphinx, context: Any, lines: list[str]) -> None:
    # a line that begins with two dots is markup; only other lines may have bars to escape
    lines[:] = [line if line.lstrip().startswith("..") else _escaped(line) for line in lines]


def setup(app: Sphinx) -> dict[str, bool]:
    app.connect("autodoc-process-docstring", _process, priority=100)  # before napoleon
    app.connect("sphinx-click-process-description", _process_help)
    app.connect("sphinx-click-process-options", _process_help)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
