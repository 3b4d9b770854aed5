"""Text of others, such as names in a model file, made safe for a terminal."""

from __future__ import annotations

import unicodedata

#: Categories of Unicode that a terminal acts on instead of showing them: control characters,
#: invisible format characters (some reverse the direction of text), lone surrogates, and the
#: separators of lines and paragraphs.
_ACTIVE = frozenset({"Cc", "Cf", "Cs", "Zl", "Zp"})


def printable(text: str, *, keep: str = "") -> str:
    r"""The text with each active character as its escape, such as \x1b.

    Without this a name in a file could set the title of the terminal, move the cursor, or hide and
    replace what was printed before.

    Parameters
    ----------
    text : str
    keep : str, default none
        Active characters that stay, such as "\n".
    """
    if text.isascii() and text.isprintable():
        return text
    return "".join(
        _escaped(c) if unicodedata.category(c) in _ACTIVE and c not in keep else c for c in text
    )


def _escaped(character: str) -> str:
    return character.encode("unicode_escape", "surrogatepass").decode("ascii")
