"""Sampling of parameter domains (paper, sec. 4.1)."""

from __future__ import annotations

import itertools
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
        """Number of parameters."""
        ...

    @property
    def free_axes(self) -> NDArray[np.bool_]:
        """Mask of the axes along which the domain has extent."""
        ...

    def from_unit(self, points: FloatArray) -> FloatArray:
        """Maps points of the unit cube, (k, dimension), into the domain."""
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
    domain : HandleBox or another domain
    count : int
        How many, > 0. A grid has the largest number of points up to `count` that a product of
        nearly equal numbers per axis of non-zero width allows: 300 in six dimensions are
        3 * 3 * 3 * 2 * 2 * 2 = 216.
    method : "random", "sobol" or "grid", default "random"
        Independent uniform points, a Sobol sequence (Sobol 1967, directions of Joe & Kuo), or the
        centres of equal cells.
    seed : int, default 0
        For "random" and for the scrambling of "sobol".
    scramble : bool, default True
        Owen's scrambling of the Sobol sequence; without it the first point is the lower corner of
        the box.

    Returns
    -------
    ndarray, (k, dimension)
        k = count except for a grid. The same arguments give the same points; longer random and
        Sobol samples begin with the shorter ones.

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
        points = np.random.default_rng(seed).random((count, domain.dimension))
    elif method == "sobol":
        points = _sobol(domain.dimension, count, seed=seed, scramble=scramble)
    elif method == "grid":
        points = _grid(domain.free_axes, count)
    else:
        raise ValueError(f"sample: unknown method '{method}'; known are {', '.join(METHODS)}")
    return domain.from_unit(points)


def _sobol(dimension: int, count: int, *, seed: int, scramble: bool) -> FloatArray:
    # imported here: scipy.stats would take a third of the time of `import snapspace`
    from scipy.stats import qmc

    generator = qmc.Sobol(dimension, scramble=scramble, seed=np.random.default_rng(seed))
    # drawing a power of two and cutting avoids SciPy's warning; every prefix is the same sequence
    points: FloatArray = generator.random_base2(max(0, math.ceil(math.log2(count))))
    return points[:count]


def _grid(free_axes: NDArray[np.bool_], count: int) -> FloatArray:
    dimension = len(free_axes)
    per_axis = [1] * dimension
    axes = itertools.cycle(np.flatnonzero(free_axes).tolist())
    axis = next(axes)
    while math.prod(per_axis) // per_axis[axis] * (per_axis[axis] + 1) <= count:
        per_axis[axis] += 1
        axis = next(axes)
    centers = [(np.arange(k) + 0.5) / k for k in per_axis]
    return np.stack(np.meshgrid(*centers, indexing="ij"), axis=-1).reshape(-1, dimension)
