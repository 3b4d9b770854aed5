"""Sampling of parameter domains (paper, sec. 4.1)."""

from __future__ import annotations

import math
from typing import Literal, Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from .arguments import require_count

FloatArray = NDArray[np.float64]
Method = Literal["random", "sobol", "grid", "blends"]
#: Methods for every domain, and all methods: "blends" is for weights of poses.
ANYWHERE: tuple[Method, ...] = ("random", "sobol", "grid")
METHODS: tuple[Method, ...] = (*ANYWHERE, "blends")


@runtime_checkable
class Domain(Protocol):
    """What a parameter domain must offer: a map from the unit cube.

    Uniform points of the cube must become uniform points of the domain.
    """

    @property
    def dimension(self) -> int:
        """Number of axes of the unit cube."""
        ...

    def from_unit(self, points: FloatArray) -> FloatArray:
        """Maps points of the unit cube, (k, dimension), into the domain: parameters (k, p)."""
        ...

    def grid(self, count: int) -> FloatArray:
        """Centres of equal cells of the domain, as many as possible up to `count`: (k, p)."""
        ...


@runtime_checkable
class BlendDomain(Domain, Protocol):
    """A domain of weights, whose corners are blended two and three at a time."""

    def blends(self, count: int, *, seed: int, scramble: bool) -> FloatArray:
        """Weights of two or three corners, and a share of weights of all corners: (count, p)."""
        ...


def sample(
    domain: Domain,
    count: int,
    *,
    method: Method = "random",
    seed: int = 0,
    scramble: bool = True,
) -> FloatArray:
    """Parameters for snapshots, spread over the domain uniformly or as people use it.

    Parameters
    ----------
    domain : HandleBox, Simplex or another domain
        The box of the handles' motions, or the simplex of interpolation weights.
    count : int
        Number of samples, > 0. A grid has the largest number of points up to `count` that its
        domain allows. In a box of six dimensions, 300 become 3 * 3 * 3 * 2 * 2 * 2 = 216, see
        `HandleBox.grid`. On the simplex of three weights, 30 become 1 + 2 + ... + 7 = 28, see
        `Simplex.grid`.
    method : "random", "sobol", "grid" or "blends", default "random"
        Independent uniform points, a Sobol sequence (Sobol 1967, directions of Joe & Kuo), or the
        centres of equal cells. "blends" is for weights of five poses or more. People blend two or
        three poses at a time, so it takes all pairs, then triples as well, with a share of uniform
        points, see `Simplex.blends`.
    seed : int, default 0
        Seed of "random", of the scrambling of "sobol" and of the order of poses in "blends".
    scramble : bool, default True
        Whether to use Owen's scrambling of the Sobol sequence. Without it the first point is the
        lower corner of the box, or the last corner of the simplex, and "blends" takes the poses in
        order.

    Returns
    -------
    ndarray, (k, p)
        One row of p parameters per sample: 6 per moving handle, or one weight per corner of the
        simplex. k = count except for a grid. The same arguments give the same points. Except for
        grids, the points of a smaller count are the first points of a larger one.

    Raises
    ------
    ValueError
        For something other than a domain, a count that is not a positive whole number, a seed that
        is not a whole number or is negative, an unknown method, or blends in a domain without them.
    """
    if not isinstance(domain, Domain):
        cure = "give problem.domain" if hasattr(domain, "domain") else "give a HandleBox or Simplex"
        raise ValueError(f"sample: the domain is a {type(domain).__name__}; {cure}")
    count = require_count("sample", "the number of samples", count, at_least=1)
    if require_count("sample", "the seed", seed) < 0:
        raise ValueError(f"sample: the seed is {seed}, but must not be negative")
    if method == "random":
        return domain.from_unit(np.random.default_rng(seed).random((count, domain.dimension)))
    if method == "sobol":
        return domain.from_unit(sobol_points(domain.dimension, count, seed=seed, scramble=scramble))
    if method == "grid":
        return domain.grid(count)
    if method == "blends":
        if not isinstance(domain, BlendDomain):
            raise ValueError(
                "sample: the method 'blends' is for weights of poses, but the domain is a "
                f"{type(domain).__name__}; use sobol"
            )
        return domain.blends(count, seed=seed, scramble=scramble)
    raise ValueError(f"sample: unknown method '{method}'; known are {', '.join(METHODS)}")


def sobol_points(dimension: int, count: int, *, seed: int, scramble: bool) -> FloatArray:
    """The first points (count, dimension) of a Sobol sequence in the unit cube."""
    # imported here: scipy.stats would take a third of the time of `import snapspace`
    from scipy.stats import qmc

    generator = qmc.Sobol(dimension, scramble=scramble, seed=np.random.default_rng(seed))
    # drawing a power of two and cutting avoids SciPy's warning; every prefix is the same sequence
    points: FloatArray = generator.random_base2(max(0, math.ceil(math.log2(count))))
    return points[:count]
