"""with_handles: any vertex becomes a handle of a reduced model at once."""

from __future__ import annotations

import numpy as np
import pytest

from snapspace import ARAP, HandleBox, PosingModel, PosingProblem, with_handles

BOX = HandleBox(translation=0.1, angle=0.2, moving=2)


def problem_with(model: PosingModel, vertex: int, *, stiffness: float) -> PosingProblem:
    old = model.problem
    handles = old.handles.without("belly").adding("point", [vertex])
    return PosingProblem(old.mesh, handles, domain=BOX, material=old.material, stiffness=stiffness)


def free_vertex(model: PosingModel) -> int:
    taken = np.concatenate([handle.vertices for handle in model.problem.handles])
    return int(np.setdiff1d(model.surface.corners[:, 0], taken)[0])


def test_its_handle_energy_is_that_of_the_problem(posing_model: PosingModel) -> None:
    vertex = free_vertex(posing_model)
    problem = problem_with(posing_model, vertex, stiffness=40.0)
    model = with_handles(posing_model, problem)
    chance = np.random.default_rng(3)
    q = 0.1 * chance.standard_normal(model.dimension)
    offsets = 0.2 * chance.standard_normal((len(problem.handles), 3, 4))
    wanted = problem.handle_energy(model.subspace.shape(q), offsets)
    assert model.handles.value(q, offsets) == pytest.approx(wanted, rel=1e-9)
    assert model.elastic is posing_model.elastic
    assert model.error_estimator is None and len(model.training_parameters) == 0


def test_a_point_comes_to_its_target_as_the_stiffness_grows(posing_model: PosingModel) -> None:
    vertex = free_vertex(posing_model)
    rest = posing_model.problem.mesh.vertices[vertex]
    pull = 0.03 * posing_model.problem.mesh.diagonal * np.array([0.6, 0.0, 0.8])
    away = []
    for stiffness in (1e2, 1e4, 1e6):
        model = with_handles(posing_model, problem_with(posing_model, vertex, stiffness=stiffness))
        session = model.session()
        assert session.move("point", translation=pull).converged
        away.append(float(np.linalg.norm(session.vertices[vertex] - rest - pull)))
    assert away[0] > 10.0 * away[1] > 10.0 * away[2]
    assert away[2] < 0.02 * np.linalg.norm(pull)


def test_another_body_is_refused(posing_model: PosingModel) -> None:
    old = posing_model.problem
    other = PosingProblem(old.mesh, old.handles, domain=BOX, material=ARAP())
    with pytest.raises(ValueError, match="with_handles: the problem has another material than"):
        with_handles(posing_model, other)
