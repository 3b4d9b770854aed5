"""NotebookPage: the page inside a notebook."""

from __future__ import annotations

import base64
import gzip
import html
import warnings

from ..arguments import is_finite, shown
from ..reduction import ReducedModel
from .export import page_with_model

#: Jupyter's gateway clients close the connection for longer messages (10 MiB with headers).
MOST_BYTES = 10_000_000

# The script is a block: global names, and the packed bytes with them, would outlive document.open.
_OPENER = """<!doctype html><meta charset="utf-8"><body><script>{{
const unpacked = async () => {{
  const packed = Uint8Array.from(atob("{content}"), (c) => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).text();
}};
unpacked().then(
  (page) => {{ document.open(); document.write(page); document.close(); }},
  (error) => {{ document.body.textContent = "This page cannot be unpacked: " + error; }},
);
}}</script>"""


class NotebookPage:
    """A page that notebooks display: the value of `model.show()` at the end of a cell.

    The page is part of the cell's output, compressed, and loads nothing else. So it works on remote
    kernels, and in notebooks that are saved and opened elsewhere. It cannot access the notebook.

    Parameters
    ----------
    model : PosingModel or InterpolationModel
    title : str
        Heading of the page.
    up : "x", "y", "z" or None
        Axis that points up at first; None: the model's own.
    height : int
        Height of the frame in pixels, 100 or more.

    Raises
    ------
    ValueError
        For a smaller height, an unknown axis, or if the package was built without its page.

    Warns
    -----
    UserWarning
        If the output has more than 10 MB, which some connections to remote kernels refuse.
    """

    def __init__(self, model: ReducedModel, *, title: str, up: str | None, height: int) -> None:
        if not (is_finite(height) and height >= 100):
            raise ValueError(
                f"show: height is {shown(height)} pixels, but the page needs 100 or more"
            )
        self._title, self._height = title, height
        self._output = self._framed(page_with_model(model, title=title, up=up))
        if len(self._output) > MOST_BYTES:
            warnings.warn(
                f"show: the output has {len(self._output) / 1e6:.1f} MB, and Jupyter's gateways "
                f"to remote kernels carry {MOST_BYTES / 1e6:.0f} MB; if nothing appears, show "
                f"fewer than {model.dimension} dimensions with `model.leading(d).show()`, or use "
                "export_html",
                stacklevel=3,
            )

    def _framed(self, page: str) -> str:
        """The page in a frame; untrusted notebooks show only the text inside the frame."""
        # fixed mtime: the same output for the same model
        packed = gzip.compress(page.encode(), compresslevel=6, mtime=0)
        opener = html.escape(_OPENER.format(content=base64.b64encode(packed).decode("ascii")))
        title = html.escape(self._title)
        style = f"width: 100%; height: {self._height}px; border: 0; border-radius: 8px"
        return (
            f'<iframe sandbox="allow-scripts" srcdoc="{opener}" title="{title}" style="{style}">'
            "The page of this model appears when the notebook is trusted, or the cell is run again."
            "</iframe>"
        )

    def _repr_html_(self) -> str:
        return self._output

    def __repr__(self) -> str:
        return f"NotebookPage({self._title!r}); notebooks display it, `export_html` writes a file"
