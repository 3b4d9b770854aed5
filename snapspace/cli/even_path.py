"""The path of `snapspace blend --path` with even motion: traced finely, then divided."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..reduction import InterpolationModel
from ..session import BlendingSession
from .even_walk import EvenWalk, Jump, PathPoint, ShapePath

FloatArray = NDArray[np.float64]

#: Steps of the trace per frame; lengths between its points are interpolated.
FINER = 2
#: A motion of more than this many even steps is a jump if no step of the weights divides it.
JUMP = 4
#: A jump is a turn of the whole body if at most this share of its motion, and no jump, is left once
#: the two shapes are registered.
TURN = 0.25


@dataclass(frozen=True)
class PathFrame:
    """Weights (poses,) of a frame; weights and coordinates (d,) of the traced shape before it."""

    weights: FloatArray
    start_weights: FloatArray
    start: FloatArray


@dataclass(frozen=True)
class PathJump:
    """The shape jumps at `weights`, before frame number `frame`.

    motion : largest motion of a vertex
    deformation : the same once the two shapes are registered
    turns : whether the body only turns as a whole, so that little is left of the motion
    """

    frame: int
    weights: FloatArray
    motion: float
    deformation: float
    turns: bool


@dataclass(frozen=True)
class EvenPath:
    """Frames of even motion, and the jumps that cannot be divided."""

    frames: list[PathFrame]
    jumps: list[PathJump]


@dataclass(frozen=True)
class Leg:
    """The traced path from a pose to the next one.

    places : points of the path
    lengths : (len(places),), how far the shape has moved at each point; jumps do not count, so no
        frame lies inside one
    jumps : jumps of the shape
    farthest : the longest motion that is not a jump
    """

    places: list[PathPoint]
    lengths: FloatArray
    jumps: list[Jump]
    farthest: float


def even_path(model: InterpolationModel, session: BlendingSession, frames: int) -> EvenPath:
    """`frames` shapes of even motion, from the first pose through all poses to the last.

    The largest motion of a vertex is the same from frame to frame. With at least as many frames as
    poses every pose is a frame, so steps of different legs differ slightly: each leg has a whole
    number of steps.
    """
    legs = _traced(model, session, frames)
    poses = len(legs) + 1
    places = [(k, *_place_at(legs[k], moved)) for k, moved in _divided(legs, frames)]
    places.append((len(legs) - 1, 1.0, legs[-1].places[-1]))
    shown = [
        PathFrame(_weights(poses, k, share), _weights(poses, k, near.share), near.q)
        for k, share, near in places
    ]
    jumps = []
    for k, leg in enumerate(legs):
        for jump in leg.jumps:
            share = jump.after.share
            frame = next(n for n, place in enumerate(places) if place[:2] >= (k, share))
            deformation = _deformation(model, jump)
            jumps.append(
                PathJump(
                    frame,
                    _weights(poses, k, share),
                    jump.motion,
                    deformation,
                    turns=deformation <= min(TURN * jump.motion, leg.farthest),
                )
            )
    return EvenPath(shown, jumps)


def _deformation(model: InterpolationModel, jump: Jump) -> float:
    """The largest motion of a vertex in a jump, once the two shapes are registered."""
    subspace = model.subspace
    before, after = (
        subspace.tau + subspace.basis[:, : len(place.q)] @ place.q
        for place in (jump.before, jump.after)
    )
    moved = model.problem.aligned(after, before) - before
    return float(np.linalg.norm(moved.reshape(-1, 3), axis=1).max())


def _divided(legs: list[Leg], frames: int) -> list[tuple[int, float]]:
    """The leg of each frame except the last, and how far the shape has moved along it."""
    lengths = np.array([leg.lengths[-1] for leg in legs])
    if frames > len(legs):
        counts = whole_steps(lengths, frames - 1)
        return [
            (k, length * step / count)
            for k, (length, count) in enumerate(zip(lengths.tolist(), counts.tolist(), strict=True))
            for step in range(count)
        ]
    ends = np.cumsum(lengths)
    moved = np.linspace(0, ends[-1], frames)[:-1]
    numbers = np.minimum(np.searchsorted(ends, moved, side="right"), len(legs) - 1)
    return list(zip(numbers.tolist(), (moved - (ends - lengths)[numbers]).tolist(), strict=True))


def whole_steps(lengths: FloatArray, steps: int) -> NDArray[np.int64]:
    """Numbers of steps of the legs, at least one each, in proportion to their lengths."""
    counts = np.ones(len(lengths), dtype=np.int64)
    for _ in range(steps - len(lengths)):
        counts[np.argmax(lengths / counts)] += 1  # the leg with the longest steps
    return counts


def _traced(model: InterpolationModel, session: BlendingSession, frames: int) -> list[Leg]:
    poses = len(model.problem.poses)
    shapes = model.problem.pose_shapes.reshape(poses, -1, 3)
    # no path is shorter than these straight lines
    straight = np.linalg.norm(np.diff(shapes, axis=0), axis=2).max(axis=1)
    even = max(float(straight.sum()), 1e-9 * model.problem.mesh.diagonal) / (frames - 1)
    farthest = JUMP * even
    basis = model.subspace.basis

    def motion(first: FloatArray, second: FloatArray) -> float:
        moved = (basis[:, : len(first)] @ (second - first)).reshape(-1, 3)
        return float(np.linalg.norm(moved, axis=1).max())

    session.blend(_weights(poses, 0, 0.0))
    q, legs = session.q, []
    for k in range(poses - 1):

        def solve(share: float, near: FloatArray, k: int = k) -> FloatArray:
            session.put(_weights(poses, k, share), near)
            session.blend(session.weights)
            return session.q

        walk = EvenWalk(
            ShapePath(solve, motion),
            q,
            length=float(straight[k]),
            even=even / FINER,
            jump=farthest,
        )
        places, lengths, jumps = [walk.at], [0.0], []
        while walk.at.share < 1:
            before, jump = walk.at, walk.step()
            if jump is not None:
                jumps.append(jump)
                places.append(jump.before)
                lengths.append(lengths[-1] + motion(before.q, jump.before.q))
            places.append(walk.at)
            moved = 0.0 if jump is not None else motion(before.q, walk.at.q)
            lengths.append(lengths[-1] + moved)
        legs.append(Leg(places, np.array(lengths), jumps, farthest))
        q = walk.at.q
    return legs


def _place_at(leg: Leg, moved: float) -> tuple[float, PathPoint]:
    """The share of a leg where the shape has moved this far, and the traced point before."""
    if moved <= 0:
        return 0.0, leg.places[0]  # exactly a pose, even if the shape rests there
    after = int(np.searchsorted(leg.lengths[1:], moved, side="right")) + 1
    if after >= len(leg.places):
        return leg.places[-1].share, leg.places[-1]
    first, last = leg.places[after - 1], leg.places[after]
    part = (moved - leg.lengths[after - 1]) / (leg.lengths[after] - leg.lengths[after - 1])
    return first.share + part * (last.share - first.share), first


def _weights(poses: int, leg: int, share: float) -> FloatArray:
    weights = np.zeros(poses)
    weights[leg] = 1.0 - share
    if share > 0:
        weights[leg + 1] = share
    return weights
