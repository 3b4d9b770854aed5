"""fit_poses: finds poses of a tet mesh that match given surfaces, without inverted tets."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import _core as core
from ..arguments import is_finite, require_count, require_function, shown
from ..blas import single_threaded_blas
from ..interruptible import run_interruptible
from ..mesh import TetMesh
from ..mesh.embedded_surface import EmbeddedSurface
from ..thread_count import checked_threads
from .moved_with_surface import moved_with_surface
from .pose_fits import PoseFit, PoseFits
from .stretches import stretches
from .targets import checked_targets, point_areas, registered_targets

FloatArray = NDArray[np.float64]
Progress = Callable[[int, int], None]
OnFinished = Callable[[int, FloatArray, PoseFit], None]

#: Default of `deviation`: 0.1 %, one pixel in a picture of the whole shape.
DEVIATION = 1e-3
#: The deviation is also limited to this share of the surface's motion: a smile moves the face by
#: less than a thousandth of the diagonal of the whole figure.
SHARE_OF_MOTION = 0.05
#: Stiffness of the first stage, in units of 1 / diagonal (the material's mu is one). It bends the
#: body but hardly stretches it, and so finds poses whose limbs turn by 180 degrees.
FIRST_STIFFNESS = 0.01
#: Limit on the stretch of tets, and the limit for surfaces that cannot be reached within it.
STRETCHES = 10.0, 100.0


@single_threaded_blas
def fit_poses(
    mesh: TetMesh,
    surface: EmbeddedSurface,
    targets: ArrayLike,
    *,
    deviation: float = DEVIATION,
    max_iterations: int = 300,
    threads: int | None = None,
    progress: Progress | None = None,
    names: Sequence[str] | None = None,
    on_finished: OnFinished | None = None,
) -> PoseFits:
    """Finds poses of a tet mesh whose embedded surface matches given surfaces.

    Parameters
    ----------
    mesh : TetMesh
        The mesh in its rest shape.
    surface : EmbeddedSurface
        Points of the surface in the tets: attributes `faces`, `corners` and `weights`.
    targets : array_like, (k, s, 3)
        Point i of the surface should reach point i of each target, up to a rigid motion of the
        target. Targets may intersect themselves.
    deviation : float, default 1e-3
        Goal: root mean square distance between the surface and its target, relative to the diagonal
        of the rest shape. Surfaces that move little are fitted to 5 % of their motion instead.
    max_iterations : int, default 300
        Largest number of Newton steps per pose.
    threads : int, optional
        Default: as many as the machine has. The result is bitwise the same for any number.
    progress : callable(done, total), optional
        Called from time to time from this thread, with numbers of poses.
    names : sequence of str, optional
        Names of the poses, for the reports. Default: their indices.
    on_finished : callable(index, shape, report), optional
        Called from this thread for each pose soon after it is finished, also on Ctrl-C. Called
        again for a pose if Ctrl-C interrupted its call.

    Returns
    -------
    PoseFits
        Shapes in the frame of the rest shape, each with a report. None has inverted tets. Shapes
        that did not converge are included; their surfaces miss the goal.

    Raises
    ------
    ValueError
        For targets that do not match the surface or are not finite, a surface of another mesh or
        without area, or options out of range.
    KeyboardInterrupt
        On Ctrl-C, after `on_finished` has been called for the finished poses.

    Notes
    -----
    Minimises the symmetric Dirichlet energy (Smith & Schaefer 2015), which resists inversion, plus
    stiffness * sum_i area_i |surface_i - target_i|^2. The stiffness is raised in stages until the
    goal is met, and no further, since tets with little distortion make good rest shapes.

    The energy of a tet grows without bound towards |F|^2 + |F^-1|^2 - 6 = 100, so no stretch is
    above 10 or below 0.1. Where folds of a surface would stretch single tets forty times, the fit
    deviates a little from the surface instead. If the goal cannot be met within these bounds, the
    fit starts again with all vertices moved like the surface near them, if that shape is less
    distorted. If it is still missed, the pose is fitted with bounds of 100 and 0.01.
    """
    surfaces, labels = checked_targets(mesh, surface, targets, names)
    _check_options(deviation, max_iterations, threads)
    for name, function in (("progress", progress), ("on_finished", on_finished)):
        require_function("fit_poses", name, function)
    fitting = _Fitting(mesh, surface, deviation, max_iterations)
    fitted: dict[int, tuple[FloatArray, PoseFit]] = {}
    announced: set[int] = set()

    def announce() -> None:
        for index in sorted(set(fitted) - announced):
            if on_finished:
                on_finished(index, *fitted[index])
            announced.add(index)  # only now, since Ctrl-C may interrupt the callback

    def show(_: int) -> None:
        announce()
        if progress:
            progress(len(announced), len(surfaces))

    def solve(control: core.SolveControl) -> None:
        def fit(index: int) -> None:
            shape, report = fitting.fit(surfaces[index], labels[index], control)
            if report.status != "cancelled":
                fitted[index] = shape, report

        with ThreadPoolExecutor(max_workers=threads or os.cpu_count()) as pool:
            list(pool.map(fit, range(len(surfaces))))

    _, interrupted = run_interruptible(solve, show)
    if interrupted:
        announce()
        raise KeyboardInterrupt(f"{len(fitted)} of {len(surfaces)} poses are finished")
    show(len(fitted))
    shapes = np.stack([fitted[i][0] for i in range(len(surfaces))])
    return PoseFits(shapes, [fitted[i][1] for i in range(len(surfaces))])


class _Fitting:
    """What all poses of one call share."""

    def __init__(
        self, mesh: TetMesh, surface: EmbeddedSurface, deviation: float, max_iterations: int
    ) -> None:
        self.mesh = mesh
        self.surface = surface
        self.deviation = deviation
        self.max_iterations = max_iterations
        self.rest = surface.vertices(mesh.vertices)
        self.areas = point_areas(self.rest, surface.faces)
        if not self.areas.sum() > 0:
            raise ValueError("fit_poses: the surface has no area; check its faces")
        self.system = core.FittingSystem(
            mesh.vertices, mesh.tets, surface.corners, surface.weights, self.areas
        )

    def fit(
        self, target: FloatArray, name: str, control: core.SolveControl
    ) -> tuple[FloatArray, PoseFit]:
        wanted = registered_targets(target[None], self.rest, self.areas)[0] - self.rest
        goal = self.deviation * self.mesh.diagonal
        moved = float(np.sqrt(self.areas @ (wanted**2).sum(axis=1) / self.areas.sum()))
        # a target may be the rest shape up to rounding, which does not count as motion
        share = max(SHARE_OF_MOTION * moved, 1e-6 * goal)

        def attempt(start: FloatArray, stretch: float) -> tuple[FloatArray, core.FitReport]:
            return self.system.fit(
                wanted,
                start,
                deviation=min(goal, share),
                first_stiffness=FIRST_STIFFNESS / self.mesh.diagonal,
                stretch=stretch,
                max_iterations=self.max_iterations,
                control=control,
            )

        for stretch in STRETCHES:
            u, report = attempt(np.zeros(self.mesh.vertices.size), stretch)
            if not _ended(report):
                near = self._moved(self.rest + wanted)
                # a slender body that turns by more than half a turn may be caught in folds
                if self._distortion(near, stretch) < self._distortion(u, stretch):
                    again, other = attempt(near, stretch)
                    if _ended(other) or other.deviation < report.deviation:
                        u, report = again, other
            if _ended(report):
                break
        shape: FloatArray = self.mesh.vertices + u.reshape(-1, 3)
        return shape, self._report(name, shape, wanted, report)

    def _moved(self, target: FloatArray) -> FloatArray:
        """Displacements (3n,) of vertices that move with the surface near them."""
        points = self.mesh.vertices
        shape = moved_with_surface(points, self.rest, target, self.surface.faces)
        return (shape - points).reshape(-1)

    def _distortion(self, u: FloatArray, stretch: float) -> float:
        """The energy at displacements (3n,), infinite if a tet is inverted."""
        return self.system.energy(u, stretch=stretch)[0]

    def _report(
        self, name: str, shape: FloatArray, wanted: FloatArray, report: core.FitReport
    ) -> PoseFit:
        values, inverted = stretches(self.mesh, shape)
        distances = np.linalg.norm(self.surface.vertices(shape) - self.rest - wanted, axis=1)
        return PoseFit(
            name=name,
            rms=report.deviation / self.mesh.diagonal,
            max=float(distances.max()) / self.mesh.diagonal,
            inverted_tets=int(inverted.sum()),
            smallest_stretch=float(values.min()),
            largest_stretch=float(values.max()),
            stages=report.stages,
            iterations=report.iterations,
            seconds=report.seconds,
            status=report.status.name,
        )


def _ended(report: core.FitReport) -> bool:
    return report.status.name in ("converged", "cancelled")


def _check_options(deviation: float, max_iterations: int, threads: int | None) -> None:
    check_deviation(deviation)
    require_count("fit_poses", "max_iterations", max_iterations, at_least=1)
    if checked_threads(threads, "fit_poses") == 0 and threads is not None:
        raise ValueError(f"fit_poses: threads is {threads}, but must be at least 1")


def check_deviation(deviation: float) -> None:
    """Raises ValueError unless the goal is positive and finite."""
    if not (is_finite(deviation) and deviation > 0):
        raise ValueError(f"fit_poses: deviation is {shown(deviation)}, but it must be positive")
