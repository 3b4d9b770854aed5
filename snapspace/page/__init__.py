"""The page: models that are posed and blended in the browser."""

from .pack import packed

__all__ = ["packed"]
