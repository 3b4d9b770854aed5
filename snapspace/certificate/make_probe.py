"""Makes the probe of a problem."""

from __future__ import annotations

from ..energy import is_of_stars
from ..problem import InterpolationProblem, PosingProblem
from ..subspace import AffineSubspace
from .element_probe import ElementProbe
from .residual_sample import ResidualSample
from .star_probe import StarProbe


def residual_probe(
    problem: PosingProblem | InterpolationProblem,
    subspace: AffineSubspace,
    sample: ResidualSample,
) -> ElementProbe | StarProbe:
    """The probe of a problem for shapes of a subspace.

    Parameters
    ----------
    problem : PosingProblem or InterpolationProblem
        The full problem.
    subspace : AffineSubspace
        The subspace of the shapes.
    sample : ResidualSample
        The sampled vertices and their weights.

    Raises
    ------
    ValueError
        If the sample has a vertex that the mesh does not have.
    """
    n, sampled = len(problem.mesh.vertices), sample.vertices
    if sampled.min() < 0 or sampled.max() >= n:
        raise ValueError(
            f"ResidualProbe: the sample has vertex {sampled.max()}, but the mesh has {n} vertices; "
            "calibrate the model again"
        )
    if is_of_stars(problem.mesh, problem.material):
        return StarProbe(problem, subspace, sample)
    return ElementProbe(problem, subspace, sample)
