"""Motions of handles on the command line: --euler belongs to the --handle before it."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import click
import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from ..problem import PosingProblem
from .options import Vector

FloatArray = NDArray[np.float64]
_ORDER = "snapspace.cli.motions.order"
_OPTIONS = ("handle", "euler", "translate")


@dataclass(frozen=True)
class Motion:
    """Extrinsic Euler angles in degrees about x, y, z, and a translation; None if not given."""

    euler: Vector | None = None
    translation: Vector | None = None


class MotionCommand(click.Command):
    """A command that remembers the order of --handle, --euler and --translate."""

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Parses as usual, and records the order of the three options."""
        _, _, order = self.make_parser(ctx).parse_args(args=list(args))
        ctx.meta[_ORDER] = [option.name for option in order if option.name in _OPTIONS]
        return super().parse_args(ctx, args)


def motions_in_order(ctx: click.Context) -> dict[str, Motion]:
    """The motion of each handle named on the command line of a `MotionCommand`."""
    values = {name: iter(ctx.params[name]) for name in _OPTIONS}
    return collect_motions([(name, next(values[name])) for name in ctx.meta[_ORDER]])


def collect_motions(items: Sequence[tuple[str, Any]]) -> dict[str, Motion]:
    """Motions by handle, from ("handle", name), ("euler", vector), ("translate", vector) in order.

    Raises
    ------
    ValueError
        For a handle given twice, a motion before any handle, or two of one kind for a handle.
    """
    motions: dict[str, Motion] = {}
    handle = None
    for option, value in items:
        if option == "handle":
            if value in motions:
                raise ValueError(
                    f"--handle {value} is given twice; put its --euler and --translate after one"
                )
            handle = value
            motions[handle] = Motion()
            continue
        if handle is None:
            raise ValueError(f"--{option} belongs to the --handle before it; put --handle first")
        motion = motions[handle]
        if (motion.euler if option == "euler" else motion.translation) is not None:
            raise ValueError(f"--{option} is given twice for handle '{handle}'; give it once")
        if option == "euler":
            motions[handle] = Motion(value, motion.translation)
        else:
            motions[handle] = Motion(motion.euler, value)
    return motions


def as_parameters(
    problem: PosingProblem, motions: dict[str, Motion]
) -> tuple[FloatArray, FloatArray]:
    """Parameters (dimension,) of the same deformation, and a rigid map (3, 4) of the result.

    The map is the motion of the first handle, since only motions relative to it deform the body. If
    the first handle does not move, the map is the identity and the parameters are the motions
    themselves. ValueError for an unknown handle.
    """
    wanted = np.zeros((len(problem.handles), 6))
    for name, motion in motions.items():
        row = wanted[problem.handles.index(name)]
        row[:3] = motion.translation or 0.0
        row[3:] = np.deg2rad(motion.euler or 0.0)
    if not wanted[0].any():
        return wanted[1:].reshape(-1), np.eye(3, 4)
    centers = problem.centroids
    turns = Rotation.from_euler("xyz", wanted[:, 3:])
    turn = turns[0]
    shift = centers[0] + wanted[0, :3] - turn.as_matrix() @ centers[0]
    places = turn.inv().apply(centers[1:] + wanted[1:, :3] - shift)
    with warnings.catch_warnings():
        # at a pitch of 90 degrees the angles are not unique; any solution is right
        warnings.filterwarnings("ignore", message="Gimbal lock")
        angles = (turn.inv() * turns[1:]).as_euler("xyz")
    carrier = np.column_stack([turn.as_matrix(), shift])
    return np.hstack([places - centers[1:], angles]).reshape(-1), carrier


def beyond_domain(problem: PosingProblem, parameters: FloatArray) -> list[str]:
    """Names of moving handles whose motion is outside the sampled domain."""
    outside = np.abs(parameters) > problem.domain.half_widths * (1 + 1e-9) + 1e-9
    rows = np.flatnonzero(outside.reshape(-1, 6).any(axis=1))
    return [problem.handles.names[1 + row] for row in rows]
