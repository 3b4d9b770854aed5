"""The page's frame in a session of Python, to compare both."""

from __future__ import annotations

import numpy as np

from snapspace import PosingModel, PosingSession

from .pages import Page


def session_at_frame(page: Page, model: PosingModel) -> PosingSession:
    """A session with the page's motions of the handles and its reduced coordinates."""
    session = model.session()
    motions = [
        (np.array(page.run(f"snapspace.session.motion({handle}).rotation")).reshape(3, 3), shift)
        for handle, (_, shift) in page.motions().items()
    ]
    session.put(motions, page.numbers("snapspace.session.q"))
    return session
