"""ServerSettings: the settings that all pages of a server share."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

from ..filling import SurfaceFilling
from ..reduction import ReducedModel
from .computation_queue import ComputationQueue
from .shared_body import SharedBody

#: 256 MB.
UPLOAD_LIMIT = 256 * 2**20


@dataclass(frozen=True, kw_only=True)
class PageTimeouts:
    """How long the workspace of a page that is gone is kept, in seconds.

    alone : usual time; a reloaded page is back in a second, a machine that wakes up takes longer
    waited_for : time if other pages wait for its computation
    """

    alone: float = 60.0
    waited_for: float = 5.0


@dataclass(frozen=True, kw_only=True)
class ServerSettings:
    """The settings that a server was started with.

    title : heading that is shown until a mesh has a name
    up : axis that points up at first; None: that of the model, problem or surface, or z
    token : secret in addresses; only letters, digits, - and _
    folder : Path of the folder where files of uploaded meshes are saved
    scratch : Path of the folder for temporary files, which the server removes at the end
    body : initial SharedBody of pages; None if they ask for a mesh
    model : model to pose or blend, instead of a body; or None
    upload_limit : largest upload, in bytes
    timeouts : how long workspaces outlive their pages
    filling : how to fill surfaces that are dropped on a page; None: with quick tets, and open
        surfaces become shells
    queue : the queue of all computations
    """

    title: str
    up: str | None
    token: str
    folder: Path
    scratch: Path
    body: SharedBody | None = None
    model: ReducedModel | None = None
    upload_limit: int = UPLOAD_LIMIT
    timeouts: PageTimeouts = field(default_factory=PageTimeouts)
    filling: SurfaceFilling | None = None
    queue: ComputationQueue = field(default_factory=ComputationQueue)
