"""SolverTraits: what a kind of problem and its material need of the solvers."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from .. import _core as core
from ..material import ARAP, Material, StVK

FloatArray = NDArray[np.float64]
Projection = Literal["stretches", "clamp", "absolute"]


@dataclass(frozen=True, kw_only=True)
class SolverTraits:
    """How full solutions of a problem are found; users can override it with `SolverOptions`.

    tolerance : tolerance of snapshots, where neither the user nor settling decides; snapshots that
        train a cubature, whose forces must be near equilibrium, never settle
    loose_tolerance : tolerance of samples for a preliminary model, see `growing_models`
    settling : share of the displacement at which the fast solver's steps may end; 0 for never
    patience : iterations of the fast solver after which `system_near` helps; None if it never does
    projection : projection of the tets' Hessians in Newton's method, see `SolverOptions`
    far_apart : whether a shape interpolated between solutions may be a worse start than the nearest
        solution
    soft_modes : returns the soft modes that the system's scalar factor treats as stiff, or None if
        unknown; the first call computes them, and the problem stores them
    system_near : returns the compiled problem for solutions near a displacement (3n,)
    seeded_tolerance : tolerance of snapshots that start from a reduced model's solutions; None if
        such starts do not pay off
    seeded_hessians : whether their seed has the model's Hessians, see `Predictions`; not where the
        system's seed has soft motions already
    polishing_hessian : whether the reduced Hessian is in the seed of `Polisher`; not where patches
        represent soft motions better
    """

    tolerance: float
    loose_tolerance: float
    settling: float
    patience: int | None
    projection: Projection
    far_apart: bool
    soft_modes: Callable[[], core.SoftModes | None]
    system_near: Callable[[FloatArray], Any]
    seeded_tolerance: float | None
    seeded_hessians: bool
    polishing_hessian: bool


#: Iterations on the shared factor after which an interpolated sample gets its own factor. Without
#: patches most samples take 200. A factor and a separate solve cost as much as about 600 iterations
#: together with others: 32 samples of ten Lions take 10.3 s with a patience of 240, 5.6 s with 400,
#: and 6.9 s with 800. Samples that start far from their minimum take 650 iterations on the shared
#: factor, or 240 on it and 220 more on their own.
PATIENCE = 400


def posing_traits(
    material: Material,
    *,
    shell: bool,
    soft_modes: Callable[[], core.SoftModes],
    system_near: Callable[[FloatArray], Any],
) -> SolverTraits:
    """Traits of posing, the only place that determines how tightly snapshots are solved.

    If the reduced energy can be an exact quartic, only the shapes matter. Their error may be as
    large as the projection error of a subspace of 40 dimensions usually is: 1 % of the
    displacement. On the Dragon a tolerance of 1e-5 leaves 0.3 %.

    All other materials are reduced to a cubature, which is trained on the forces of tets at the
    snapshots. Settled snapshots have wrinkles with forces that no solution has: on the Dragon, with
    stable neo-Hookean, they leave live errors of 0.0056 / 0.0075 (median / mean). A tolerance of
    1e-6, in single precision, leaves 0.0018 / 0.0029 (300 samples, d = 120, 1000 tets) in 13 s of
    processor time; 1e-7, in double precision, takes 24 s and leaves 0.0015 / 0.0021. The gap grows
    with d: it is 0.0028 / 0.0030 against 0.0014 / 0.0022 with 800 samples.

    Expected decreases are those of the scalar factor, which treats shear as stiff as stretch: they
    are too small by a factor of (2 mu + lam) / mu. Tolerances of nearly incompressible materials
    are lower by this factor, relative to lam = mu. On a creature with a Poisson ratio of 0.45, 1e-6
    leaves live errors of 0.0097, 1e-7 leaves 0.0039; with 0.49 they are 0.0135 and 0.0067 (d = 80).

    Shells are solved to 1e-6, in single precision: on Spot, 829 vertices, with a thickness of 3 %
    and of 1.5 % of the diagonal, 300 samples and d = 120, live errors are 0.0027 and 0.033, and
    with 1e-7 in double precision 0.0028 and 0.032, in 2.5 times the time. Plane stress never locks.

    36 loose samples of the Dragon, d = 28, make a model with a live error of 0.048 (median, stable
    neo-Hookean); with a loose tolerance of 1e-2 it is 0.060, and 3 % of the time are saved.

    Snapshots that a model predicts are solved to the same tolerance as others. With 1e-5 a dog and
    a Dragon with handles at their tips are left with errors of 0.0072 and 0.0079 instead of 0.0050
    and 0.0056 (421 samples), and builds are no faster.

    Guesses may have inverted tets. Where their energy is infinite, samples start from the known
    shape of lowest energy.

    Newton's method uses the paper's projection for the paper's material.

    The handles' matrix is part of every Hessian, so one factor is good for all samples, with
    unlimited patience. Interpolated starts were never worse than the nearest sample on the Dragon.
    """
    settles = material.exact_degree == 4 and not shell
    tolerance = 1e-5 if settles else 1e-7 * _shear_share(material)
    if shell:
        tolerance = 1e-6
    return SolverTraits(
        tolerance=tolerance,
        loose_tolerance=1e-3,
        settling=1e-2 if settles else 0.0,
        patience=None,
        projection=usual_projection(material, shell=shell),
        far_apart=material.barrier,
        soft_modes=soft_modes,
        system_near=system_near,
        seeded_tolerance=None if shell else tolerance,
        seeded_hessians=True,
        polishing_hessian=True,
    )


def usual_projection(material: Material, *, shell: bool) -> Projection:
    """Newton's default projection: the paper's for tets of the paper's material."""
    return "stretches" if isinstance(material, StVK) and not shell else "clamp"


def _shear_share(material: Material) -> float:
    """The smallest mu / (2 mu + lam) of all tets, relative to that of lam = mu, but at most 1."""
    return min(1.0, 3.0 * float(np.min(np.divide(material.mu, material.stiffness))))


def interpolation_traits(
    material: Material, *, shell: bool, system_near: Callable[[FloatArray], Any]
) -> SolverTraits:
    """Traits of interpolation.

    Nothing holds the shape, and soft directions differ between poses. So soft modes are unknown,
    and shapes move along them in steps too short for the settling test: the tolerance must be
    tight. Halfway between distant poses a blend of solutions shrinks and inverts.

    As-rigid-as-possible surfaces have patches in their seed. They take 25 to 37 evaluations, or 14
    to 28 from a model's solutions, and are as close to the minimum with 1e-7 as with 1e-9. Four
    Lions of tets take 35 from a model's solutions, and 33 with its Hessians as well.
    """
    patches_suffice = shell and isinstance(material, ARAP)
    return SolverTraits(
        tolerance=1e-9,
        loose_tolerance=1e-6,
        settling=0.0,
        patience=PATIENCE,
        projection=usual_projection(material, shell=shell),
        far_apart=True,
        soft_modes=lambda: None,
        system_near=system_near,
        seeded_tolerance=1e-8 if patches_suffice else None,
        seeded_hessians=False,
        polishing_hessian=not patches_suffice,
    )
