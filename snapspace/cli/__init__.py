"""The command line: the pipeline over files."""

from .main import main
from .program import program

__all__ = ["main", "program"]
