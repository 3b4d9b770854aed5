"""The command line: the whole pipeline on files."""

from .main import main
from .program import program

__all__ = ["main", "program"]
