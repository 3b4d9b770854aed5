"""solved_from: a frame solved from given coordinates."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from .session import Session

FloatArray = NDArray[np.float64]


def solved_from(session: Session[Any], q: FloatArray) -> FloatArray:
    """Coordinates (d,) of the minimum for the current parameters to which a start q (d,) leads.

    The session keeps them.
    """
    session._loop.q = q
    session.solve()
    return session.q.copy()
