"""A blend next to the mean shape does not judge: its relative error means nothing."""

from __future__ import annotations

import numpy as np

from snapspace import InterpolationProblem, TetMesh
from snapspace.accurate.growing_samples import GrowingSamples
from snapspace.accurate.solving import Solving
from snapspace.generators import bar

from ..shapes import bent


def test_a_blend_next_to_the_mean_shape_does_not_judge() -> None:
    mesh = bar(6, 1, 1)
    problem = InterpolationProblem([mesh, TetMesh(bent(mesh, 1.2), mesh.tets)])
    samples = GrowingSamples(problem, 8, method="blends", seed=0, first=4, held_out=4)
    parameters = samples.parameters.copy()
    parameters[5] = [0.501, 0.499]
    samples.__dict__["parameters"] = parameters
    samples.solve_up_to(8, Solving(threads=1), predict=lambda: None)
    judges = samples.unseen.parameters
    assert len(judges) == 3 and not np.isclose(judges[:, 0], 0.501).any()
    assert samples.projection_errors().shape[1] == 3
    assert samples.held_out.sum() == 4, "it does not train either"
