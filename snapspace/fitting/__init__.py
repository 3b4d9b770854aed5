"""Fitting: tet poses whose surfaces match given ones."""

from .fit import DEVIATION, fit_poses
from .pose_fits import PoseFit, PoseFits

__all__ = ["DEVIATION", "PoseFit", "PoseFits", "fit_poses"]
