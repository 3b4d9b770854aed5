"""The page: poses and blends models in the browser."""

from .export import export_html, export_packed, page_with_model, page_with_packed
from .pack import packed
from .show import NotebookPage

__all__ = [
    "NotebookPage",
    "export_html",
    "export_packed",
    "packed",
    "page_with_model",
    "page_with_packed",
]
