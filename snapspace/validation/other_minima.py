"""other_minima: which frames are at another minimum of the reduced energy than full solutions."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..mesh import mass_norms
from ..reduction import ReducedModel
from ..session import Session, solved_from
from ..snapshots import Snapshots
from .lower_minima import APART

FloatArray = NDArray[np.float64]


def other_minima(model: ReducedModel, reference: Snapshots, which: ArrayLike) -> NDArray[np.bool_]:
    """Whether frames are at another minimum than the one next to the full solution.

    Parameters
    ----------
    model : PosingModel or InterpolationModel
    reference : Snapshots
        Full solutions of its problem.
    which : (k,) int
        Indices of the samples to look at. Each one takes two reduced solves.

    Returns
    -------
    (k,) bool
        Whether a reduced solve that starts at the projection of the full solution ends elsewhere.
    """
    indices = np.asarray(which, np.intp)
    if not len(indices):
        return np.zeros(0, bool)
    some = reference.select(indices)
    rows = some.displacements.shifted(model.problem.base - model.subspace.tau)
    projections = model.subspace.row_coordinates(rows)
    sizes = mass_norms(model.subspace.mass, rows.array())
    session = model.session()
    samples = zip(some.parameters, projections, sizes, strict=True)
    pairs = [frame_and_near(session, w, start, size) for w, start, size in samples]
    return np.array([near is not frame for frame, near in pairs], bool)


def frame_and_near(
    session: Session[Any], w: FloatArray, projection: FloatArray, size: float
) -> tuple[FloatArray, FloatArray]:
    """Coordinates (d,) of a frame and of the reduced minimum next to a full solution.

    Both are the same array if they are at most 2 % of the displacement's norm `size` apart, which
    is within the tolerance of two solves.

    Parameters
    ----------
    session : a session of the model
    w : (p,), parameters of the sample
    projection : (d,), coordinates of the projection of the full solution
    size : norm of its displacement from tau
    """
    session.reset()
    session.set_parameters(w)
    frame = session.q.copy()
    near = solved_from(session, projection)
    return (frame, frame) if np.linalg.norm(near - frame) <= APART * size else (frame, near)
