"""A local server for the page."""

from .serve import serve

__all__ = ["serve"]
