"""Parametrised shape problems."""

from .certain_range import CertainRange, certain_range
from .handle_box import HandleBox
from .handle_stiffness import handle_misses, usual_stiffness
from .handles import Handle, Handles
from .interpolation_problem import InterpolationProblem
from .motion import affine_offset, euler_of_rotation, rigid_offset, rotation_matrix
from .poses import Poses
from .posing_problem import PosingProblem
from .problem import Problem, is_quartic, solutions_beyond_tau
from .problem_file import (
    check_problem,
    problem_content,
    problem_surface_file,
    problem_thickness,
    read_problem,
    read_problem_surface,
)
from .problem_types import require_posing_problem, require_problem
from .region import in_box, in_sphere
from .shell_poses import ShellPoses
from .simplex import Simplex
from .solver_traits import Projection, SolverTraits, usual_projection
from .surface_handles import handles_in_tets

__all__ = [
    "CertainRange",
    "Handle",
    "HandleBox",
    "Handles",
    "InterpolationProblem",
    "Poses",
    "PosingProblem",
    "Problem",
    "Projection",
    "ShellPoses",
    "Simplex",
    "SolverTraits",
    "affine_offset",
    "certain_range",
    "check_problem",
    "euler_of_rotation",
    "handle_misses",
    "handles_in_tets",
    "in_box",
    "in_sphere",
    "is_quartic",
    "problem_content",
    "problem_surface_file",
    "problem_thickness",
    "read_problem",
    "read_problem_surface",
    "require_posing_problem",
    "require_problem",
    "rigid_offset",
    "rotation_matrix",
    "solutions_beyond_tau",
    "usual_projection",
    "usual_stiffness",
]
