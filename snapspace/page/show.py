"""The page inside of a notebook."""

from __future__ import annotations

import html

from ..reduction import ReducedModel
from .export import page_with_model


class NotebookPage:
    """A page that notebooks display: the value of `model.show()` at the end of a cell.

    The page is part of the cell's output and needs no server, so it works on remote kernels, and in
    notebooks that are saved and opened elsewhere.
    """

    def __init__(self, model: ReducedModel, *, title: str, up: str, height: int) -> None:
        if height < 100:
            raise ValueError(f"show: height is {height} pixels, but the page needs 100 or more")
        self._page = page_with_model(model, title=title, up=up)
        self._title, self._height = title, height

    def _repr_html_(self) -> str:
        page, title = html.escape(self._page), html.escape(self._title)
        style = f"width: 100%; height: {self._height}px; border: 0; border-radius: 8px"
        return f'<iframe srcdoc="{page}" title="{title}" style="{style}"></iframe>'

    def __repr__(self) -> str:
        return f"NotebookPage({self._title!r}); notebooks display it, `export_html` writes a file"
