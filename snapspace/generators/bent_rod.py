"""Bent rods: centre lines and frames of limbs that bend and twist smoothly."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

# Number of integration steps, for any mesh: a pose is the same at all resolutions.
_STEPS = 240
# Bending stays below this share of the curvature at which the inner side would fold.
_FOLD = 0.55
# Share of the length, from the root, over which bending sets in.
_ROOT = 0.2


def bent_rod(
    coefficients: FloatArray, length: float, radii: tuple[float, float]
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Integrates curvature and twist from the root, where the rod is straight.

    Parameters
    ----------
    coefficients : ndarray, (3, j)
        Angles of the twist and of the bends about the second and third axis, in radians. Column i
        is the amplitude of cos(i pi s / length).
    length : float
        Arc length of the centre line.
    radii : (float, float)
        Distance of the farthest point of a cross-section from the centre line, at root and tip.

    Returns
    -------
    s : ndarray, (k,)
        Arc lengths, evenly from 0 to length.
    centre : ndarray, (k, 3)
        The centre line; it starts at 0 along the first axis.
    frames : ndarray, (k, 3, 3)
        Rotations; the columns are the tangent and the two axes of the cross-section. Curvature
        times radius stays below 0.55, so no cross-section meets the next one.
    """
    u = (np.arange(_STEPS) + 0.5) / _STEPS
    root = np.clip(u / _ROOT, 0.0, 1.0)
    modes = np.cos(np.pi * np.arange(coefficients.shape[1])[:, None] * u)
    rates = (coefficients @ modes) * (root * root * (3.0 - 2.0 * root)) / length
    radius = radii[0] + (radii[1] - radii[0]) * u
    share = np.hypot(rates[1], rates[2]) * radius / _FOLD
    rates[1:] /= np.sqrt(1.0 + share**2)

    step = length / _STEPS
    turns, halves = _rotations(rates.T * step), _rotations(rates.T * (0.5 * step))
    frames = np.empty((_STEPS + 1, 3, 3))
    frames[0] = np.eye(3)
    centre = np.zeros((_STEPS + 1, 3))
    for k in range(_STEPS):
        frames[k + 1] = frames[k] @ turns[k]
        centre[k + 1] = centre[k] + step * (frames[k] @ halves[k])[:, 0]
    return np.linspace(0.0, length, _STEPS + 1), centre, frames


def rod_points(
    rod: tuple[FloatArray, FloatArray, FloatArray], s: FloatArray, offsets: FloatArray
) -> FloatArray:
    """Points (k, 3) at arc lengths s (k,) and offsets (k, 2) along the axes of cross-sections."""
    places, centre, frames = rod
    index = np.minimum(np.searchsorted(places, s, side="right") - 1, len(places) - 2)
    share = ((s - places[index]) / (places[index + 1] - places[index]))[:, None]
    middle = (1.0 - share) * centre[index] + share * centre[index + 1]
    # neighbouring frames differ by a few degrees at most, so their mean is nearly a rotation
    blend = (1.0 - share)[..., None] * frames[index] + share[..., None] * frames[index + 1]
    points: FloatArray = middle + np.einsum("kij,kj->ki", blend[:, :, 1:], offsets)
    return points


def _rotations(vectors: FloatArray) -> FloatArray:
    """Rotations (k, 3, 3) of rotation vectors (k, 3), by the formula of Rodrigues."""
    angle = np.linalg.norm(vectors, axis=1)
    axis = vectors / np.where(angle > 0.0, angle, 1.0)[:, None]
    cross = np.zeros((len(vectors), 3, 3))
    cross[:, [2, 0, 1], [1, 2, 0]] = axis
    cross[:, [1, 2, 0], [2, 0, 1]] = -axis
    sine, versine = np.sin(angle)[:, None, None], (1.0 - np.cos(angle))[:, None, None]
    rotations: FloatArray = np.eye(3) + sine * cross + versine * (cross @ cross)
    return rotations
