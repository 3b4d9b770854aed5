"""Fitting: poses of a tet mesh whose surfaces match given ones."""

from .fit import DEVIATION, check_deviation, fit_poses
from .pose_fits import PoseFit, PoseFits

__all__ = ["DEVIATION", "PoseFit", "PoseFits", "check_deviation", "fit_poses"]
