"""The built page (web/): one file inside the package."""

from __future__ import annotations

from functools import cache
from pathlib import Path

#: Placeholder in the page for a model or its address.
PLACE = "<!-- model -->"

# beside this file, also in editable installs: tools/build_page.py writes it there
_FILE = Path(__file__).with_name("page.html")


@cache
def page_html() -> str:
    """The page without a model.

    Raises
    ------
    ValueError
        If the package was built without it because tools/build_page.py had not run.
    """
    try:
        return _FILE.read_text(encoding="utf-8")
    except FileNotFoundError:
        raise ValueError(
            "this copy of snapspace has no page; run `python tools/build_page.py` in its sources, "
            "or install the package again"
        ) from None
