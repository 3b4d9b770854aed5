"""HeldFilling: a filling that waits for the test."""

from __future__ import annotations

import threading
from collections.abc import Callable
from dataclasses import dataclass, field

from snapspace import TetMesh
from snapspace.filling import SurfaceFilling
from snapspace.stopping import check_stop


@dataclass(frozen=True)
class HeldFilling(SurfaceFilling):
    """Waits until it is let go, or stopped; then it gives tets, or fails with a message.

    outcome : the tets, or the message
    """

    outcome: TetMesh | str = ""
    let_go: threading.Event = field(default_factory=threading.Event)

    def fill(self, *_: object, stage: Callable[..., None]) -> TetMesh:
        stage("filling")
        while not self.let_go.wait(0.01):
            check_stop()
        if isinstance(self.outcome, str):
            raise ValueError(self.outcome)
        return self.outcome
