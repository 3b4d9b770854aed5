"""Where a solve starts: guesses from the samples that are finished."""

from __future__ import annotations

import contextlib
from collections.abc import Sequence
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import RBFInterpolator
from scipy.spatial import cKDTree

from .. import _core as core
from ..blas import single_threaded_blas
from ..displacements import DisplacementRows

FloatArray = NDArray[np.float64]
Kernel = Literal["linear", "thin_plate_spline"]

#: Samples around a wanted one that its start is interpolated from. On the Dragon 64 and all of
#: 300 give starts of the same quality, and a bound keeps the cost of a start constant.
NEIGHBOURS = 64
#: Samples for each parameter from which on thin plates take over from linear functions.
ENOUGH_FOR_PLATES = 4
#: Sum of the absolute weights of a start that is still trusted; those of the Dragon's are below 6.
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

    Arguments and result as for `nearest_start`. On 32 samples of the Dragon after 48 finished ones
    such starts need 82 evaluations each, against 105 from the nearest sample and 145 from the rest
    shape (without soft modes).
    """
    return rows.combined(interpolation_weights(known, wanted))


@single_threaded_blas
def interpolation_weights(known: FloatArray, wanted: FloatArray) -> FloatArray:
    """Weights (j, k) of known samples whose combinations are interpolated at the wanted ones.

    With fewer than two distinct samples it is one that has all the weight.
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
    """Weights (j, k) of distinct points (k, p): of thin plates, where the points carry them.

    Thin plates have half the error of the linear functions, and save one in twenty evaluations of
    the Dragon. They need points in all directions, several times as many as there are.
    """
    weights, steady = np.zeros((len(wanted), len(points))), np.zeros(len(wanted), bool)
    if len(points) >= ENOUGH_FOR_PLATES * points.shape[1]:
        # neighbours in one plane have no plates, in nearly one large weights of both signs
        with contextlib.suppress(np.linalg.LinAlgError):
            weights = _radial_weights(points, wanted, kernel="thin_plate_spline", degree=1)
            steady = np.abs(weights).sum(axis=1) < WILDEST_WEIGHTS
    if not steady.all():
        weights[~steady] = _radial_weights(points, wanted[~steady], kernel="linear", degree=0)
    return weights


def _radial_weights(
    points: FloatArray, wanted: FloatArray, *, kernel: Kernel, degree: int
) -> FloatArray:
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
    """The guess (j, 3n) of lowest energy, sample by sample, for inputs (j, input_size).

    Between distant poses an interpolated shape shrinks and turns inside out, and a solve from there
    may end in a minimum that is far from the others; energies with a barrier are infinite there.
    The first of equal guesses wins.
    """
    count = len(inputs)
    values = system.evaluate(
        np.vstack(guesses), np.tile(inputs, (len(guesses), 1)), threads=threads
    )
    lowest = np.argmin(values[0].reshape(-1, count), axis=0)
    starts: FloatArray = np.stack(guesses)[lowest, np.arange(count)]
    return starts
