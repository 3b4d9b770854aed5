"""printable: makes text from files, such as names in a model, safe for a terminal."""

from __future__ import annotations

import unicodedata

#: Unicode categories that a terminal acts on instead of showing them: control characters,
#: invisible format characters (some reverse the direction of text), lone surrogates, and the
#: separators of lines and paragraphs.
_ACTIVE = frozenset({"Cc", "Cf", "Cs", "Zl", "Zp"})


def printable(text: str, *, keep: str = "") -> str:
    r"""The text with each active character escaped, such as \x1b.

    Without this a name in a file could set the title of the terminal, move the cursor, or hide and
    replace what was printed before.

    Parameters
    ----------
    text : str
        Any text.
    keep : str, default none
        Active characters to keep, such as "\n".
    """
    if text.isascii() and text.isprintable():
        return text
    return "".join(
        _escaped(c) if unicodedata.category(c) in _ACTIVE and c not in keep else c for c in text
    )


def _escaped(character: str) -> str:
    return character.encode("unicode_escape", "surrogatepass").decode("ascii")
