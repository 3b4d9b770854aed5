"""Sampling of parameter domains (paper, sec. 4.1)."""

from __future__ import annotations

import math
from typing import Literal, Protocol

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
Method = Literal["random", "sobol", "grid"]
METHODS: tuple[Method, ...] = ("random", "sobol", "grid")


class Domain(Protocol):
    """What a parameter domain must offer: an image of the unit cube.

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
        """Centres of equal cells of the domain, as many as there can be up to `count`: (k, p)."""
        ...


def sample(
    domain: Domain,
    count: int,
    *,
    method: Method = "random",
    seed: int = 0,
    scramble: bool = True,
) -> FloatArray:
    """Parameters for snapshots, spread uniformly over the domain.

    Parameters
    ----------
    domain : HandleBox, Simplex or another domain
        The box of the handles' motions, or the simplex of interpolation weights.
    count : int
        How many, > 0. A grid has the largest number of points up to `count` that its domain allows:
        in a box of six dimensions 300 are 3 * 3 * 3 * 2 * 2 * 2 = 216, see `HandleBox.grid`; on the
        simplex of three weights 30 are 1 + 2 + ... + 7 = 28, see `Simplex.grid`.
    method : "random", "sobol" or "grid", default "random"
        Independent uniform points, a Sobol sequence (Sobol 1967, directions of Joe & Kuo), or the
        centres of equal cells.
    seed : int, default 0
        For "random" and for the scrambling of "sobol".
    scramble : bool, default True
        Owen's scrambling of the Sobol sequence; without it the first point is the lower corner of
        the box, or the last corner of the simplex.

    Returns
    -------
    ndarray, (k, p)
        One row of p parameters per sample: 6 per moving handle, or one weight per corner of the
        simplex. k = count except for a grid. The same arguments give the same points; longer
        random and Sobol samples begin with the shorter ones.

    Raises
    ------
    ValueError
        For a count below 1, a negative seed or an unknown method.
    """
    if count < 1:
        raise ValueError(f"sample: the number of samples is {count}, but must be at least 1")
    if seed < 0:
        raise ValueError(f"sample: the seed is {seed}, but must not be negative")
    if method == "random":
        return domain.from_unit(np.random.default_rng(seed).random((count, domain.dimension)))
    if method == "sobol":
        return domain.from_unit(_sobol(domain.dimension, count, seed=seed, scramble=scramble))
    if method == "grid":
        return domain.grid(count)
    raise ValueError(f"sample: unknown method '{method}'; known are {', '.join(METHODS)}")


def _sobol(dimension: int, count: int, *, seed: int, scramble: bool) -> FloatArray:
    # imported here: scipy.stats would take a third of the time of `import snapspace`
    from scipy.stats import qmc

    generator = qmc.Sobol(dimension, scramble=scramble, seed=np.random.default_rng(seed))
    # drawing a power of two and cutting avoids SciPy's warning; every prefix is the same sequence
    points: FloatArray = generator.random_base2(max(0, math.ceil(math.log2(count))))
    return points[:count]
