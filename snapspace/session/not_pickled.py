"""NotPickled: base of objects that cannot leave this process."""

from __future__ import annotations

from typing import NoReturn


class NotPickled:
    """Refuses pickling: a session holds the state of compiled solvers, including threads."""

    def __reduce__(self) -> NoReturn:
        """Raises a TypeError that says what to do instead of pickling or copying."""
        raise TypeError(
            f"{type(self).__name__}: a session cannot be pickled or copied, since it holds the "
            "state of compiled solvers; pickle session.model, and call model.session() where it "
            "arrives (put(..., session.q) brings it to the same frame)"
        )
