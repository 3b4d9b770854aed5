"""first_motion: a motion within the box, for the command that a build suggests."""

from __future__ import annotations

import numpy as np

from ..problem import PosingProblem

#: Degrees of the suggested rotation, if the box allows them.
_DEGREES = 20.0


def first_motion(problem: PosingProblem) -> list[str]:
    """Options of `snapspace pose` for one motion that the samples contain.

    They turn the first handle that turns, about z if it can, or move the first one that moves.
    Rotations do not change a handle of one vertex.
    """
    bounds = problem.domain.bounds
    turns = np.rad2deg(bounds[:, 3:])
    moving = list(problem.handles)[1:]
    turns[[len(handle.vertices) == 1 for handle in moving]] = 0.0
    if turns.any():
        row = int(np.argmax(turns.any(axis=1)))
        axis = 2 - int(np.argmax(turns[row, ::-1] > 0))
        option, most = "--euler", min(turns[row, axis], 2 * _DEGREES)
    else:
        row = int(np.argmax(bounds[:, :3].any(axis=1)))
        axis = int(np.argmax(bounds[row, :3]))
        option, most = "--translate", bounds[row, axis]
    numbers = ["0"] * 3
    numbers[axis] = f"{most / 2:.2g}"
    return ["--handle", moving[row].name, option, ",".join(numbers)]
