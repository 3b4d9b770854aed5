"""NotPickled: what is tied to this process says so."""

from __future__ import annotations

from typing import NoReturn


class NotPickled:
    """Of sessions: they are the state of compiled solvers, threads among it."""

    def __reduce__(self) -> NoReturn:
        """TypeError with what to do instead of pickling or copying."""
        raise TypeError(
            f"{type(self).__name__}: a session is not pickled or copied, since it is the state of "
            "compiled solvers; pickle session.model, and call model.session() where it arrives "
            "(put(..., session.q) brings it to the same frame)"
        )
