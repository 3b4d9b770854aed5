"""`python -m snapspace` runs the command `snapspace`."""

from .cli import program

program()
