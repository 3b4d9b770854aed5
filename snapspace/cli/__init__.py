"""The command line: the pipeline over files."""

from .main import main

__all__ = ["main"]
