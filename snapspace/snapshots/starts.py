"""Starts of solves: guesses from finished samples."""

from __future__ import annotations

import contextlib
from collections.abc import Sequence
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from .. import _core as core
from ..blas import single_threaded_blas
from ..displacements import DisplacementRows

FloatArray = NDArray[np.float64]
Kernel = Literal["linear", "thin_plate_spline"]

#: A start is interpolated from this many nearest samples. On the Dragon 64 and all of 300 give
#: starts of the same quality, and a bound keeps the cost of a start constant.
NEIGHBOURS = 64
#: From this many samples per parameter on, thin-plate splines replace linear functions.
ENOUGH_FOR_PLATES = 4
#: Largest sum of absolute weights of a trusted start; on the Dragon the sums are below 6.
WILDEST_WEIGHTS = 10.0


def nearest_start(known: FloatArray, rows: DisplacementRows, wanted: FloatArray) -> FloatArray:
    """The shape of the nearest known sample (paper, sec. 4.2).

    Parameters
    ----------
    known : (k, p) scaled parameters
    rows : (k, 3n) their displacements
    wanted : (j, p) scaled parameters

    Returns
    -------
    ndarray, (j, 3n)
    """
    _, index = cKDTree(known).query(wanted)
    return np.stack([rows[int(i)] for i in np.atleast_1d(index)])


def interpolated_start(known: FloatArray, rows: DisplacementRows, wanted: FloatArray) -> FloatArray:
    """Shapes interpolated between the nearest known samples by radial basis functions.

    Arguments and result are as for `nearest_start`. On 32 samples of the Dragon after 48 finished
    ones, such starts need 82 evaluations each, against 105 from the nearest sample and 145 from
    the rest shape (without soft modes).
    """
    return rows.combined(interpolation_weights(known, wanted))


@single_threaded_blas
def interpolation_weights(known: FloatArray, wanted: FloatArray) -> FloatArray:
    """Weights (j, k) that interpolate the known samples at the wanted ones.

    With fewer than two distinct samples, the first one has all the weight.
    """
    # the interpolant needs distinct points, but a sample may repeat another one or the rest pose
    distinct = np.sort(np.unique(known.round(9), axis=0, return_index=True)[1])
    weights = np.zeros((len(wanted), len(known)))
    if len(distinct) < 2:
        weights[:, 0] = 1.0
    else:
        weights[:, distinct] = _weights_of_distinct(known[distinct], wanted)
    return weights


def _weights_of_distinct(points: FloatArray, wanted: FloatArray) -> FloatArray:
    """Weights (j, k) of distinct points (k, p), by thin-plate splines if there are enough points.

    Thin-plate splines have half the error of linear functions, and on the Dragon save one in twenty
    evaluations. They need points in all directions, several times as many as parameters.
    """
    weights, steady = np.zeros((len(wanted), len(points))), np.zeros(len(wanted), bool)
    if len(points) >= ENOUGH_FOR_PLATES * points.shape[1]:
        # the splines fail for neighbours in one plane; near that case, weights are large with both
        # signs
        with contextlib.suppress(np.linalg.LinAlgError):
            weights = _radial_weights(points, wanted, kernel="thin_plate_spline", degree=1)
            steady = np.abs(weights).sum(axis=1) < WILDEST_WEIGHTS
    if not steady.all():
        weights[~steady] = _radial_weights(points, wanted[~steady], kernel="linear", degree=0)
    return weights


def _radial_weights(
    points: FloatArray, wanted: FloatArray, *, kernel: Kernel, degree: int
) -> FloatArray:
    # imported here: scipy.interpolate takes a sixth of the time of loading this package
    from scipy.interpolate import RBFInterpolator

    neighbours = min(NEIGHBOURS, len(points))
    data = np.eye(len(points))
    interpolant = RBFInterpolator(points, data, kernel=kernel, degree=degree, neighbors=neighbours)
    return np.asarray(interpolant(wanted), np.float64)


def lowest_start(
    system: core.SampleSystem,
    inputs: FloatArray,
    guesses: Sequence[FloatArray],
    *,
    threads: int = 0,
) -> FloatArray:
    """The guess (j, 3n) of lowest energy for each sample, for inputs (j, input_size).

    Between distant poses an interpolated shape shrinks and inverts. Then energies with a barrier
    are infinite, and a solve may end in a minimum far from the others. Among equal guesses the
    first one is used.
    """
    count = len(inputs)
    values = system.evaluate(
        np.vstack(guesses), np.tile(inputs, (len(guesses), 1)), threads=threads
    )
    lowest = np.argmin(values[0].reshape(-1, count), axis=0)
    starts: FloatArray = np.stack(guesses)[lowest, np.arange(count)]
    return starts
