"""Parametrised shape problems."""

from .handle_box import HandleBox
from .handles import Handle, Handles
from .motion import affine_offset, rigid_offset, rotation_matrix
from .posing_problem import PosingProblem
from .problem_file import problem_content, read_problem
from .region import in_box, in_sphere

__all__ = [
    "Handle",
    "HandleBox",
    "Handles",
    "PosingProblem",
    "affine_offset",
    "in_box",
    "in_sphere",
    "problem_content",
    "read_problem",
    "rigid_offset",
    "rotation_matrix",
]
