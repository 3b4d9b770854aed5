"""fit_poses: poses of a tet mesh whose surfaces match given ones, without inverted tets."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import _core as core
from ..blas import single_threaded_blas
from ..interruptible import run_interruptible
from ..mesh import TetMesh
from ..mesh.embedded_surface import EmbeddedSurface
from .pose_fits import PoseFit, PoseFits
from .stretches import stretches
from .targets import checked_targets, point_areas, registered_targets

FloatArray = NDArray[np.float64]
Progress = Callable[[int, int], None]
OnFinished = Callable[[int, FloatArray, PoseFit], None]

#: Default of `deviation`: a tenth of a percent, which in a picture of the whole shape is a pixel.
DEVIATION = 1e-3
#: However small `deviation` allows it to be, the surface goes this share of its way at most astray:
#: a smile moves the face by less than a thousandth of the diagonal of the whole figure.
SHARE_OF_MOTION = 0.05
#: Stiffness of the first stage, in units of 1 / diagonal (the material's mu is one). The body is
#: bent, but hardly stretched: poses whose limbs turn by half a turn find their way.
FIRST_STIFFNESS = 0.01
#: Stretch that tets stay below, and the same for surfaces that cannot be reached so.
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
        The rest shape.
    surface : EmbeddedSurface
        Points of the surface in the tets: attributes `faces`, `corners` and `weights`.
    targets : array_like, (k, s, 3)
        Point i of the surface belongs at point i of each target, up to one rigid motion of the
        target. Targets may intersect themselves.
    deviation : float, default 1e-3
        Goal: root mean square distance between the surface and its target, relative to the diagonal
        of the rest shape. Surfaces that move little are fitted to 5 % of their motion instead.
    max_iterations : int, default 300
        Newton steps per pose.
    threads : int, optional
        Default: as many as the machine has. The result is bitwise the same for any number.
    progress : callable(done, total), optional
        Called now and then, from this thread.
    names : sequence of str, optional
        Of the poses, for the reports. Default: their indices.
    on_finished : callable(index, shape, report), optional
        Called from this thread for each pose, soon after it is finished; on Ctrl-C too, and again
        for a pose whose call was interrupted.

    Returns
    -------
    PoseFits
        Shapes in the frame of the rest shape, with a report each. None has inverted tets. Not each
        has to be converged: a goal that cannot be reached leaves the surface off its target.

    Raises
    ------
    ValueError
        For targets that do not fit the surface or are not finite, a surface of another mesh or
        without area, or options out of range.
    KeyboardInterrupt
        On Ctrl-C, after `on_finished` was called for the finished poses.

    Notes
    -----
    Minimises the symmetric Dirichlet energy (Smith & Schaefer 2015), which resists inversion, plus
    stiffness * sum_i area_i |surface_i - target_i|^2. The stiffness is raised in stages, and no
    further once the goal is met: tets as little distorted as the goal allows make good rest shapes.

    The energy of a tet grows without end towards |F|^2 + |F^-1|^2 - 6 = 100: no stretch is beyond
    10, nor below 0.1. Where folds of a surface would stretch single tets forty times, the surface
    is left by a little instead. If the goal cannot be met so, the pose is fitted with bounds of 100
    and 0.01.
    """
    surfaces, labels = checked_targets(mesh, surface, targets, names)
    _check_options(deviation, max_iterations, threads)
    fitting = _Fitting(mesh, surface, deviation, max_iterations)
    fitted: dict[int, tuple[FloatArray, PoseFit]] = {}
    announced: set[int] = set()

    def announce() -> None:
        for index in sorted(set(fitted) - announced):
            if on_finished:
                on_finished(index, *fitted[index])
            announced.add(index)  # after: Ctrl-C may fall into the callback

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
    """What the poses of one call share."""

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
        # a target that is the rest shape up to rounding has no motion to speak of
        share = max(SHARE_OF_MOTION * moved, 1e-6 * goal)
        for stretch in STRETCHES:
            u, report = self.system.fit(
                wanted,
                deviation=min(goal, share),
                first_stiffness=FIRST_STIFFNESS / self.mesh.diagonal,
                stretch=stretch,
                max_iterations=self.max_iterations,
                control=control,
            )
            if report.status.name in ("converged", "cancelled"):
                break
        shape: FloatArray = self.mesh.vertices + u.reshape(-1, 3)
        return shape, self._report(name, shape, wanted, report)

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


def _check_options(deviation: float, max_iterations: int, threads: int | None) -> None:
    check_deviation(deviation)
    if max_iterations < 1:
        raise ValueError(f"fit_poses: max_iterations is {max_iterations}, but must be at least 1")
    if threads is not None and threads < 1:
        raise ValueError(f"fit_poses: threads is {threads}, but must be at least 1")


def check_deviation(deviation: float) -> None:
    """ValueError unless the goal is positive."""
    if not (np.isfinite(deviation) and deviation > 0):
        raise ValueError(f"fit_poses: deviation is {deviation}, but it must be positive")
