"""solve_snapshots: full-space solutions of all samples."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict, dataclass, replace
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import _core as core
from ..interruptible import run_interruptible
from ..problem import Problem
from .checkpoint import Checkpoint
from .fast_solve import as_sample_report, solve_fast
from .snapshots import SampleReport, Snapshots
from .starts import interpolated_start, lower_start, nearest_start

FloatArray = NDArray[np.float64]
Solver = Literal["fast", "newton"]
SOLVERS: tuple[Solver, ...] = ("fast", "newton")
Progress = Callable[[int, int], None]


class Interrupted(KeyboardInterrupt):
    """Ctrl-C during `solve_snapshots`; the finished samples are in its checkpoint, if any."""


@dataclass(frozen=True, kw_only=True)
class SolverOptions:
    """How samples are solved.

    Parameters
    ----------
    solver : "fast" or "newton", default "fast"
        L-BFGS on a scalar factor that all samples share, or the paper's Newton method (sec. 4.2).
    tolerance : float, optional
        Converged when twice the decrease that the solver's model predicts is below tolerance * F,
        and for "fast" the mean decrease of the last 8 iterations is as well. Default: the
        problem's `snapshot_tolerance`.
    max_iterations : int, default 1000
        Per sample; one that needs more ends as max_iterations.
    clamp : float, default 0.65
        Newton only: singular values are raised to this in the Hessian; the paper uses 0.5 to 0.8.
    wave : int, optional
        Samples solved together; they start from the samples of earlier waves only, so that results
        do not depend on threads. Default 32 for "fast", 2 for "newton".

    Raises
    ------
    ValueError
        For an unknown solver, or a number that is not positive or not in its range.
    """

    solver: Solver = "fast"
    tolerance: float | None = None
    max_iterations: int = 1000
    clamp: float = 0.65
    wave: int | None = None

    def __post_init__(self) -> None:
        if self.solver not in SOLVERS:
            raise ValueError(f"unknown solver '{self.solver}'; known are {', '.join(SOLVERS)}")
        if self.tolerance is not None and not (np.isfinite(self.tolerance) and self.tolerance > 0):
            raise ValueError(f"tolerance is {self.tolerance}, but it must be positive")
        if self.max_iterations < 1:
            raise ValueError(f"max_iterations is {self.max_iterations}, but must be at least 1")
        if not 0 < self.clamp <= 1:
            raise ValueError(f"clamp is {self.clamp}, but it must be in (0, 1]")
        if self.wave is not None and self.wave < 1:
            raise ValueError(f"wave is {self.wave}, but must be at least 1")

    def resolved(self, problem: Problem) -> SolverOptions:
        """The options with the problem's tolerance and the solver's wave where none are given."""
        return replace(
            self,
            tolerance=problem.snapshot_tolerance if self.tolerance is None else self.tolerance,
            wave=self.wave_size,
        )

    @property
    def wave_size(self) -> int:
        """Samples per wave."""
        return self.wave or (32 if self.solver == "fast" else 2)


def solve_snapshots(
    problem: Problem,
    parameters: ArrayLike,
    *,
    options: SolverOptions | None = None,
    threads: int | None = None,
    progress: Progress | None = None,
    checkpoint: Checkpoint | None = None,
) -> Snapshots:
    """Solves the full nonlinear problem for each sample (paper, sec. 4.2).

    Parameters
    ----------
    problem : Problem
    parameters : array_like, (k, problem.parameter_count)
        For example from `sample`.
    options : SolverOptions, optional
    threads : int, optional
        Default: as many as the machine has. The result is bitwise the same for any number.
    progress : callable(done, total), optional
        Called now and then, from this thread.
    checkpoint : Checkpoint, optional
        Finished samples are saved there wave by wave, and on Ctrl-C; a run with the same arguments
        goes on from them and ends with the same result as one that was not interrupted.

    Returns
    -------
    Snapshots
        In the order of `parameters`, with a report each. Not every sample has to be converged:
        `snapshot_pca` leaves out those that are not.

    Raises
    ------
    ValueError
        For parameters of the wrong shape or not finite.
    Interrupted
        On Ctrl-C, after the finished samples were saved.
    """
    samples = _checked(problem, parameters)
    chosen = (options or SolverOptions()).resolved(problem)
    run = _Run(problem, samples, chosen, threads or 0, progress, checkpoint)
    for begin in range(0, len(samples), run.options.wave_size):
        run.solve_wave(range(begin, min(begin + run.options.wave_size, len(samples))))
    reports = [run.reports[i] for i in range(len(samples))]
    return Snapshots(problem, samples, (run.displacements + problem.base).T, reports)


def solver_key(options: SolverOptions, problem: Problem) -> dict[str, Any]:
    """What of the options the solutions of a problem depend on."""
    return asdict(options.resolved(problem))


class _Run:
    """One call of solve_snapshots: what is solved so far."""

    def __init__(
        self,
        problem: Problem,
        samples: FloatArray,
        options: SolverOptions,
        threads: int,
        progress: Progress | None,
        checkpoint: Checkpoint | None,
    ) -> None:
        self.problem = problem
        self.samples = samples
        self.options = options
        self.threads = threads
        self.progress = progress or (lambda done, total: None)
        self.checkpoint = checkpoint
        self.displacements = np.zeros((len(samples), problem.mesh.vertices.size))
        self.reports: dict[int, SampleReport] = {}
        for index, (shape, report) in (checkpoint.load() if checkpoint else {}).items():
            self.displacements[index] = shape
            self.reports[index] = report

    def solve_wave(self, wave: range) -> None:
        """Solves what is missing of a wave, starting from the samples of earlier waves."""
        missing = [i for i in wave if i not in self.reports]
        if not missing:
            return
        # for the whole wave: products with fewer rows round differently, and which samples are
        # missing depends on where an earlier run was interrupted
        rows = np.subtract(missing, wave.start)
        inputs = self.problem.inputs(self.samples[wave])
        starts, inputs = self._starts(wave, inputs)[rows], inputs[rows]
        already, total = len(self.reports), len(self.samples)
        solved, interrupted = run_interruptible(
            lambda control: self._solve(inputs, starts, control, wave=len(wave)),
            # slow samples are counted twice
            lambda finished: self.progress(already + min(finished, len(missing)), total),
        )
        shapes, reports = solved
        done = [k for k, report in enumerate(reports) if report.status != "cancelled"]
        if done:
            places = [missing[k] for k in done]
            self.displacements[places] = self.problem.registered(shapes[done])
        for k in done:
            self.reports[missing[k]] = reports[k]
        if self.checkpoint and done:
            self.checkpoint.save(
                places, self.displacements[places], [self.reports[i] for i in places]
            )
        if interrupted:
            raise Interrupted(f"{len(self.reports)} of {total} samples are finished")

    def _starts(self, wave: range, inputs: FloatArray) -> FloatArray:
        """Guesses from the converged samples before the wave, and from what is known anyway."""
        known = [i for i in range(wave.start) if self.reports[i].converged]
        given, shapes = self.problem.known_solutions()
        scaled = self.problem.domain.scaled
        parameters = scaled(np.vstack([given, self.samples[known]]))
        displacements = np.vstack([shapes - self.problem.base, self.displacements[known]])
        wanted = scaled(self.samples[wave])
        if self.options.solver == "newton":
            return nearest_start(parameters, displacements, wanted)
        interpolated = interpolated_start(parameters, displacements, wanted)
        if not self.problem.solutions_far_apart:
            return interpolated
        nearest = nearest_start(parameters, displacements, wanted)
        return lower_start(self.problem.system, inputs, interpolated, nearest)

    def _solve(
        self, inputs: FloatArray, starts: FloatArray, control: core.SolveControl, *, wave: int
    ) -> tuple[FloatArray, list[SampleReport]]:
        options = self.options
        assert options.tolerance is not None  # resolved
        common: dict[str, Any] = {
            "tolerance": options.tolerance,
            "max_iterations": options.max_iterations,
            "threads": self.threads,
        }
        if options.solver == "fast":
            return solve_fast(self.problem, inputs, starts, control, wave=wave, **common)
        batch = self.problem.system.solve_newton(
            inputs, starts, clamp=options.clamp, control=control, **common
        )
        return batch.shapes, [as_sample_report(report) for report in batch.reports]


def _checked(problem: Problem, parameters: ArrayLike) -> FloatArray:
    samples = np.ascontiguousarray(parameters, dtype=np.float64)
    if samples.ndim != 2 or samples.shape[1] != problem.parameter_count or len(samples) == 0:
        raise ValueError(
            f"solve_snapshots: parameters have shape {samples.shape}, but the problem needs "
            f"(samples, {problem.parameter_count})"
        )
    bad = np.flatnonzero(~np.isfinite(samples).all(axis=1))
    if bad.size:
        raise ValueError(f"solve_snapshots: sample {bad[0]} has a parameter that is not finite")
    for index, w in enumerate(samples):
        try:
            problem.check(w)
        except ValueError as error:
            raise ValueError(f"solve_snapshots: sample {index}: {error}") from None
    return samples
