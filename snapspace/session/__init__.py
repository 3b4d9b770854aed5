"""Sessions: live solves of reduced models."""

from .blending_session import BlendingSession
from .dynamics import Dynamics
from .frame_report import FrameReport
from .mirror_pose import mirror_pose
from .polish import Polished
from .posing_session import PosingSession
from .predictions import predicted_solutions
from .session import Session
from .solved_from import solved_from

__all__ = [
    "BlendingSession",
    "Dynamics",
    "FrameReport",
    "Polished",
    "PosingSession",
    "Session",
    "mirror_pose",
    "predicted_solutions",
    "solved_from",
]
