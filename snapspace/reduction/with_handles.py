"""with_handles: a posing model with other handles, at once."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..problem import PosingProblem, require_posing_problem
from .check_model import check_model
from .handle_quadric import handle_quadric
from .posing_model import PosingModel


def with_handles(model: PosingModel, problem: PosingProblem) -> PosingModel:
    """The same subspace and elastic energy with the handles of another problem.

    Nothing is solved or trained: the quadric of a handle needs only the basis rows of its vertices.
    So any vertex can be pulled at once. The subspace was not made for the new handles, so frames
    are less accurate than those of a model that was; `accurate_model(problem, start=model)` makes
    one.

    Parameters
    ----------
    model : PosingModel
    problem : PosingProblem
        The same mesh and material, with any handles and stiffness.

    Returns
    -------
    PosingModel
        Its handle energy is that of the problem on the subspace. It has no training samples and no
        error estimator, since the old ones were for other handles.

    Raises
    ------
    ValueError
        For another mesh or material, or for a model or problem without handles.
    """
    check_model(model, "with_handles")
    require_posing_problem(model.problem, "with_handles")
    require_posing_problem(problem, "with_handles")
    old = model.problem
    for what, own, other in (
        ("mesh", old.mesh.fingerprint, problem.mesh.fingerprint),
        ("material", old.material.key, problem.material.key),
    ):
        if own != other:
            raise ValueError(
                f"with_handles: the problem has another {what} than the model; build a model of it"
            )
    record = {key: value for key, value in model.provenance.items() if key == "up"}
    return replace(
        model,
        problem=problem,
        handles=handle_quadric(problem, model.subspace),
        training_parameters=np.zeros((0, problem.parameter_count)),
        training_coordinates=np.zeros((0, model.dimension)),
        error_estimator=None,
        provenance=record,
    )
