"""Models of every registered material, with different moduli in every tet."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from snapspace import Cubature, PosingModel, PosingProblem
from snapspace.certificate import ErrorEstimator, residual_sample, scalar_diagonal
from snapspace.material import Material, material_class


def with_material(problem: PosingProblem, material: Material) -> PosingProblem:
    """The same problem with another material."""
    return PosingProblem(
        problem.mesh,
        problem.handles,
        domain=problem.domain,
        material=material,
        stiffness=problem.stiffness,
    )


def varied_material(kind: str, tets: int) -> Material:
    """Stiff at one end: mu from 0.5 to 5, lam from 1 to 3."""
    along = np.linspace(0.0, 1.0, tets)
    return material_class(kind).from_lame(lam=1.0 + 2.0 * along, mu=0.5 * 10.0**along)


def material_model(model: PosingModel, kind: str) -> PosingModel:
    """A model with a cubature, of another material and with an uncalibrated estimator."""
    old = model.elastic
    assert isinstance(old, Cubature)
    material = varied_material(kind, len(model.problem.mesh.tets))
    problem = with_material(model.problem, material)
    changed = replace(
        model,
        problem=problem,
        elastic=Cubature.of_tets(problem, model.subspace, old.tets, old.weights),
    )
    return replace(changed, error_estimator=some_estimator(changed))


def some_estimator(model: PosingModel) -> ErrorEstimator:
    """Ratios of 0.5 to 2 at random frames, residuals at 40 vertices."""
    rng = np.random.default_rng(4)
    diagonal = scalar_diagonal(model.problem)
    return ErrorEstimator(
        mass=model.problem.mesh.volume,
        sample=residual_sample(np.ones(len(diagonal)), diagonal, count=40),
        coordinates=model.coordinate_scale * rng.normal(size=(12, model.dimension)),
        residual_ratios=rng.uniform(0.5, 2.0, 12),
        movement_ratios=rng.uniform(0.5, 2.0, 12),
        exponent=1.6,
    )
