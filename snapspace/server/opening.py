"""Opening: what a page is told while its body is read and filled."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from .user_surface import UserSurface


@dataclass(frozen=True)
class Opening:
    """Takes what is known of a body before it is there.

    stage : called with a stage, and where it is counted with what is done and all there is
    read : called with a surface that has been read, before it is filled with tets
    """

    stage: Callable[..., None]
    read: Callable[[UserSurface], None] = lambda _: None
