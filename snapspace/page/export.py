"""Export: one HTML file with the page and a model, which opens from disk without a network."""

from __future__ import annotations

import base64
import html
import zlib
from pathlib import Path

from ..arguments import as_path
from ..disk.atomic_file import atomic_file
from ..reduction import ReducedModel, check_model
from .pack import packed, packed_name
from .page_file import PLACE, page_html

SUFFIXES = (".html", ".htm")
_TITLE = "<title>Snapspace</title>"


def page_with_model(model: ReducedModel, *, title: str, up: str | None = None) -> str:
    """The page as HTML text, with a model embedded.

    Parameters
    ----------
    model : PosingModel or InterpolationModel
    title : str
        Heading of the page, and title of the window.
    up : "x", "y" or "z", default the model's own
        Axis that points up at first.

    Raises
    ------
    ValueError
        For an unknown axis, or if the package was built without its page.
    """
    return page_with_packed(packed(model, name=title, up=up))


def page_with_packed(content: bytes) -> str:
    """The page as HTML text, with the content of `packed` embedded, and its name as the title.

    ValueError if the package was built without its page.
    """
    title = packed_name(content)
    encoded = base64.b64encode(content).decode("ascii")
    # the page checks it before it shows the model
    checksum = f"{zlib.crc32(content):08x}"
    element = (
        f'<script id="model" data-crc32="{checksum}" type="application/octet-stream">'
        f"{encoded}</script>"
    )
    page = page_html()
    for place in (PLACE, _TITLE):
        if page.count(place) != 1:
            raise ValueError(f"the page of this package has no {place}; install the package again")
    return page.replace(PLACE, element).replace(
        _TITLE, f"<title>{html.escape(title, quote=False)}</title>"
    )


def export_html(
    model: ReducedModel, path: str | Path, *, title: str | None = None, up: str | None = None
) -> Path:
    """Writes one self-contained file that poses or blends a model in any browser.

    Parameters
    ----------
    model : PosingModel or InterpolationModel
    path : str or Path
        Ends in .html or .htm.
    title : str, optional
        Default: the file's name without its extension.
    up : "x", "y" or "z", default the model's own
        Axis that points up at first.

    Returns
    -------
    Path
        The file. If writing fails, no incomplete file is left behind.

    Raises
    ------
    ValueError
        For something other than a model, an unknown extension, or if the file cannot be written.
    """
    check_model(model, "export_html", "give model, path")
    path = as_path("export_html", path)
    if path.suffix.lower() not in SUFFIXES:
        raise ValueError(f"{path}: the name of a page must end in {' or '.join(SUFFIXES)}")
    content = page_with_model(model, title=path.stem if title is None else title, up=up)
    with atomic_file(path) as temporary:
        temporary.write_text(content, encoding="utf-8")
    return path


def export_packed(
    model: ReducedModel, path: str | Path, *, title: str | None = None, up: str | None = None
) -> Path:
    """Writes what a page needs of a model, for the web component <snapspace-viewer>.

    The file has the surface only, modes as 16-bit integers and coefficients in single precision: it
    is a fraction of the model's file. `load` does not read it.

    Parameters
    ----------
    model : PosingModel or InterpolationModel
    path : str or Path
        Ends in .snapspace.
    title : str, optional
        Default: the file's name without its extension.
    up : "x", "y" or "z", default the model's own
        Axis that points up at first.

    Returns
    -------
    Path
        The file. If writing fails, no incomplete file is left behind.

    Raises
    ------
    ValueError
        For something other than a model, an unknown extension, or if the file cannot be written.
    """
    check_model(model, "export_packed", "give model, path")
    path = as_path("export_packed", path)
    if path.suffix.lower() != ".snapspace":
        raise ValueError(f"{path}: the name of a packed model must end in .snapspace")
    content = packed(model, name=path.stem if title is None else title, up=up)
    with atomic_file(path) as temporary:
        temporary.write_bytes(content)
    return path
