"""Opening: reports to a page while its body is read and filled."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from .user_surface import UserSurface


@dataclass(frozen=True)
class Opening:
    """Receives what is known about a body before it exists.

    stage : called with a stage and, if it is counted, with the numbers done and in all
    read : called with a surface that has been read, before it is filled with tets
    """

    stage: Callable[..., None]
    read: Callable[[UserSurface], None] = lambda _: None
