"""Polishing: improves shapes that the page solved, in the full space."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..reduction import ReducedModel
from ..session import BlendingSession, PosingSession
from .messages import Polish, Polished

#: Largest number of iterations: more would let a page keep this machine busy.
MOST_ITERATIONS = 1000


@dataclass
class Polishing:
    """Polishes frames of one model; shared preparations are made with the first."""

    model: ReducedModel

    def __post_init__(self) -> None:
        self._session = self.model.session()

    def polish(self, order: Polish) -> tuple[bytes, Polished]:
        """The binary frame with the shape, and the message after it.

        Raises
        ------
        ValueError
            For a frame that does not fit the model, or iterations out of range.
        Stopped
            If this thread is asked to stop.
        """
        if not 0 <= order.iterations <= MOST_ITERATIONS:
            raise ValueError(
                f"polish: iterations is {order.iterations}, but it must be from 0 to "
                f"{MOST_ITERATIONS}"
            )
        session = self._session
        if isinstance(session, PosingSession):
            motions = [
                (np.array(motion.rotation).reshape(3, 3), motion.translation)
                for motion in order.handles
            ]
            session.put(motions, order.q)
        elif isinstance(session, BlendingSession):
            session.put(order.weights, order.q)
        done = session.polish(iterations=order.iterations)
        shown = self.model.surface.vertices(done.vertices).astype("<f4")
        request = np.array([order.request], "<i4")
        return request.tobytes() + shown.tobytes(), Polished(
            request=order.request,
            moved=done.moved_relative if np.isfinite(done.moved_relative) else None,
            iterations=done.report.iterations,
            status=done.report.status,
            seconds=done.seconds,
        )
