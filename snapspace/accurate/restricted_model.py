"""Restricted models: a model without some of its handles, at once."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ..mesh import EmbeddedSurface
from ..problem import PosingProblem
from ..reduction import PosingModel, with_handles
from ..reduction.shown_surface import surface_in
from ..reduction.training_samples import training_samples
from ..snapshots import Snapshots


def restricted_model(
    model: PosingModel, problem: PosingProblem, surface: EmbeddedSurface | None
) -> PosingModel | None:
    """A model of fewer handles, without solving or training; None if the problem needs more.

    Where a handle was removed, the body is free, and its shapes are near those with the handle
    somewhere in its old range. So the subspace and the tets of the energy remain good for motions
    within the old bounds.

    Parameters
    ----------
    model : PosingModel
        The model of all handles.
    problem : PosingProblem
        A problem of the same mesh.
    surface : as for `reduce`

    Returns
    -------
    PosingModel or None
        Its training samples are the model's, whose shapes include the effect of the removed
        handles. None if a handle is new or has wider bounds, another one is fixed, or the material
        differs.

    Raises
    ------
    ValueError
        If the surface belongs to another mesh.
    """
    old = model.problem
    first, *others = problem.handles.places_in(old.handles)
    moving = [place - 1 for place in others if place is not None]
    if first != 0 or len(moving) < len(others) or problem.material.key != old.material.key:
        return None
    if (problem.domain.bounds > old.domain.bounds[moving]).any():
        return None
    motions = model.training_parameters.reshape(len(model.training_parameters), -1, 6)
    return replace(
        with_handles(model, problem),
        surface=surface_in(problem.mesh, surface, who="accurate_model"),
        training_parameters=motions[:, moving].reshape(len(motions), -1),
        training_coordinates=model.training_coordinates,
    )


def with_starts(model: PosingModel, near: Snapshots, unjudged: NDArray[np.bool_]) -> PosingModel:
    """The model with reduced solutions as further training samples.

    A restricted model needs them: jumps that start only from samples with more handles may end in
    another minimum.

    unjudged : (k,), which of the model's own training samples stay: those that are not held out
    """
    parameters, coordinates = training_samples(model.problem, model.subspace, near)
    return replace(
        model,
        training_parameters=np.vstack([model.training_parameters[unjudged], parameters]),
        training_coordinates=np.vstack([model.training_coordinates[unjudged], coordinates]),
    )
