"""The warnings of this package that tell the user something, and are no mistake of the program."""

from __future__ import annotations


class Notice(UserWarning):
    """Base of all notices; the command line shows each as one line."""
