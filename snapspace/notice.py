"""Notice: warnings that inform the user, and do not point to a mistake in the program."""

from __future__ import annotations


class Notice(UserWarning):
    """Base of all notices; the command line shows each as one line."""
