"""`python -m snapspace` is `snapspace`."""

from .cli import program

program()
