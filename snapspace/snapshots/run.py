"""Run: one call of solve_snapshots, from its first block to its last sample."""

from __future__ import annotations

import time
import warnings
from collections.abc import Callable, Sequence
from concurrent.futures import Executor
from dataclasses import replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..displacements import DisplacementRows
from ..interruptible import begin_abandonable
from ..problem import Problem
from ..stopping import check_stop, ctrl_c_at_checks
from .backend import Backend
from .checkpoint import Checkpoint, CheckpointNotice, UnsavedSamplesError, run_key
from .executor_backend import ExecutorBackend
from .guesses import Guesses
from .held_out import HeldOutError
from .local_backend import LocalBackend
from .predictions import Predictions
from .schedule import Schedule
from .snapshots import SampleReport, Snapshots
from .solve_progress import Progress, SolveProgress
from .solved import Solved
from .solver_options import ResolvedOptions
from .starts import interpolated_start, lowest_start, nearest_start

FloatArray = NDArray[np.float64]

POLL_SECONDS = 0.1
#: How long Ctrl-C waits for solvers to stop; they check between the parts of an iteration.
STOP_SECONDS = 0.4


class Interrupted(KeyboardInterrupt):
    """Ctrl-C during `solve_snapshots`; the finished samples are in its checkpoint, if any.

    finished : Snapshots of the finished samples, in order; None if there are none, or if samples
        are chosen during the run
    """

    def __init__(self, message: str, finished: Snapshots | None = None) -> None:
        super().__init__(message)
        self.finished = finished


class Run:
    """The state of a run: which samples are submitted, finished and saved.

    Parameters
    ----------
    problem, samples, options, progress, checkpoint, known, predictions, threads : as for
        `solve_snapshots`
    """

    def __init__(
        self,
        problem: Problem,
        samples: FloatArray,
        options: ResolvedOptions,
        *,
        progress: Progress | None,
        checkpoint: Checkpoint | None,
        known: Snapshots | None,
        predictions: Predictions | None,
        threads: int,
    ) -> None:
        self.problem = problem
        self.threads = threads
        self.predictions = predictions
        predicted = predictions if options.solver == "fast" else None
        self.basis = None if predicted is None else predicted.basis
        self.samples = samples
        self.options = options
        self.checkpoint = checkpoint
        self.progress = progress
        self.schedule = Schedule(len(samples), options.block, strict=options.solver == "newton")
        self.begin = time.perf_counter()
        self.rows: dict[int, FloatArray] = {}
        self.reports: dict[int, SampleReport] = {}
        self.unsaved: list[int] = []
        self.save_size = options.block  # number of samples to save together
        self.complete = 0  # number of finished leading blocks
        self.quick: list[list[int]] = []  # for leading blocks: samples from which others start
        self.key = run_key(problem, samples, options.as_key()) if checkpoint else ""
        for index, (row, report) in (checkpoint.load(run=self.key) if checkpoint else {}).items():
            self.rows[index], self.reports[index] = row, report
        self.found = len(self.reports)
        self.estimate: float | None = None
        given, shapes = problem.known_solutions()
        self.known_parameters = given
        self.known_rows = DisplacementRows(shapes - problem.base, problem.base.size)
        if known is not None:
            known = known.select(known.usable)
            self.known_parameters = np.vstack([given, known.parameters])
            self.known_rows = self.known_rows.followed_by(known.displacements)
        self.guesses = Guesses(problem, np.vstack([self.known_parameters, samples]))

    @cached_property
    def held_out(self) -> HeldOutError:
        """Error of the leading blocks, for `progress`; made while the first samples are solved."""
        return HeldOutError(self.problem)

    def solve(self, executor: Executor | None) -> Snapshots:
        """Solves the missing samples and returns all of them; raises Interrupted on Ctrl-C."""
        try:
            with ctrl_c_at_checks():
                self._solve(executor)
                every = self._snapshots_of(range(len(self.samples)))
                return replace(every, gram=self.held_out.gram) if self.progress else every
        except KeyboardInterrupt:
            done = f"{len(self.reports)} of {len(self.samples)} samples are finished"
            finished = self._snapshots_of(sorted(self.reports)) if self.reports else None
            raise Interrupted(done, finished) from None

    def _solve(self, executor: Executor | None) -> None:
        missing = len(self.samples) - self.found
        if not missing:
            self._advance()
            self._report_progress()
            return
        finish_guesses = self._begin_guesses()  # in parallel with the backend's preparations
        backend: Backend
        if executor is None:
            backend = LocalBackend(
                self.problem, self.options, expected=missing, threads=self.threads, basis=self.basis
            )
        else:
            backend = ExecutorBackend(executor, self.problem, self.options, basis=self.basis)
        try:
            finish_guesses()
            self._solve_with(backend)
        except KeyboardInterrupt:
            self._record(backend.stop(STOP_SECONDS))
            raise
        finally:
            self._save()
            backend.close()

    def _begin_guesses(self) -> Callable[[], None]:
        """Starts making guesses for the first block; the returned function waits for them."""
        if self.found or self.options.solver == "newton" or self.predictions is not None:
            return lambda: None
        _ = self.problem.system  # otherwise two threads could both make it
        given = len(self.known_parameters)
        first = [given + i for i in self.schedule.samples(0)]
        return begin_abandonable(lambda: self.guesses.make(first, known=given))

    def _snapshots_of(self, numbers: Sequence[int]) -> Snapshots:
        rows = DisplacementRows([self.rows[i] for i in numbers], self.problem.base.size)
        reports = [self.reports[i] for i in numbers]
        return Snapshots(self.problem, self.samples[np.array(numbers)], rows, reports)

    def _solve_with(self, backend: Backend) -> None:
        submitted = 0
        while len(self.reports) < len(self.samples):
            check_stop()
            self._advance()
            while submitted < len(self.schedule) and self._ready(submitted, backend):
                check_stop()
                self._submit(backend, submitted)
                submitted += 1
                if submitted == len(self.schedule):
                    backend.no_more()
            self._report_progress()
            self._record(backend.wait(POLL_SECONDS))
            if len(self.unsaved) >= self.save_size:
                self._save()
        self._advance()
        self._report_progress()

    def _ready(self, index: int, backend: Backend) -> bool:
        """Whether it is known which samples a block starts from."""
        before = self.schedule.before(index)
        finished = {i: report.evaluations for i, report in self.reports.items()}
        while len(self.quick) < len(before):
            quick = self.schedule.quick(len(self.quick), finished, backend.running())
            if quick is None:
                return False
            self.quick.append(quick)
        return True

    def _advance(self) -> None:
        """Counts the leading blocks that are finished."""
        while self.complete < len(self.schedule):
            block = self.schedule.samples(self.complete)
            if any(i not in self.reports for i in block):
                break
            self.complete += 1
            if self.unsaved and self.save_size == self.options.block:
                self._save()  # before the Gram matrix keeps references to rows in memory
            if self.progress:
                self._estimate_error(block.stop, last=self.complete == len(self.schedule))

    def _estimate_error(self, finished: int, *, last: bool) -> None:
        """Estimates the error from the leading samples, for `progress`.

        It adds samples in growing parts, since each part of the Gram matrix reads all earlier rows.
        """
        added = len(self.held_out.gram)
        if finished < 1.5 * added and not last:
            return
        rows = [self.rows[i] for i in range(added, finished)]
        self.held_out.add(rows, threads=self.threads)
        converged = np.array([self.reports[i].converged for i in range(finished)])
        self.estimate = self.held_out.of_last(converged, finished - added)

    def _submit(self, backend: Backend, index: int) -> None:
        block = self.schedule.samples(index)
        missing = [i for i in block if i not in self.reports]
        if not missing:
            return
        # for the whole block, since products with fewer rows round differently, and the missing
        # samples depend on where an earlier run was interrupted
        inputs = self.problem.inputs(self.samples[block])
        starts = self._starts(index, inputs)
        if self.predictions is not None and self.options.solver == "fast":
            inputs = self.predictions.with_inverses(inputs, slice(block.start, block.stop))
        if len(missing) < len(block):
            which = np.subtract(missing, block.start)
            inputs, starts = inputs[which], starts[which]
        backend.submit(missing, inputs, starts)

    def _starts(self, index: int, inputs: FloatArray) -> FloatArray:
        """Starts for a block from converged samples before it and from the known ones."""
        block = self.schedule.samples(index)
        quick = [i for earlier in self.schedule.before(index) for i in self.quick[earlier]]
        before = [i for i in quick if self.reports[i].converged]
        scaled = self.problem.domain.scaled
        parameters = scaled(np.vstack([self.known_parameters, self.samples[before]]))
        rows = self.known_rows.followed_by([self.rows[i] for i in before])
        wanted = scaled(self.samples[block])
        newton = self.options.solver == "newton"
        if self.predictions is not None:
            guessed = self.predictions.displacements[block.start : block.stop]
        elif newton:
            guessed = nearest_start(parameters, rows, wanted)
        else:
            guessed = self._guessed(block, before, rows, parameters)
        if newton or not self.problem.solving.far_apart:
            return guessed
        nearest = nearest_start(parameters, rows, wanted)
        tau = np.broadcast_to(self.problem.tau - self.problem.base, nearest.shape)
        guesses = [guessed, nearest, tau]
        return lowest_start(self.problem.system, inputs, guesses, threads=self.threads)

    def _guessed(
        self, block: range, before: Sequence[int], rows: DisplacementRows, scaled: FloatArray
    ) -> FloatArray:
        """The problem's guesses for a block, or shapes interpolated from finished samples.

        scaled : parameters of the rows, which are the known samples and those before the block
        """
        given = len(self.known_parameters)
        finished = [*range(given), *(given + i for i in before)]
        corrected = self.guesses.corrected([given + i for i in block], finished, rows)
        if corrected is not None:
            return corrected
        return interpolated_start(scaled, rows, self.problem.domain.scaled(self.samples[block]))

    def _record(self, solved: Sequence[Solved]) -> None:
        for one in solved:
            self.rows[one.sample] = self.problem.registered(one.displacement[None])[0]
            self.reports[one.sample] = one.report
            self.unsaved.append(one.sample)

    def _save(self) -> None:
        """Saves unsaved samples; if that fails, they stay in memory for the next try."""
        if self.checkpoint is None or not self.unsaved:
            return
        places = sorted(self.unsaved)
        rows, reports = [self.rows[i] for i in places], [self.reports[i] for i in places]
        try:
            rows = self.checkpoint.save(places, rows, reports, run=self.key)
        except UnsavedSamplesError as error:
            warnings.warn(str(error), CheckpointNotice, stacklevel=2)
            self.save_size = len(places) + self.options.block
            return
        self.rows.update(zip(places, rows, strict=True))
        self.unsaved.clear()
        self.save_size = self.options.block

    def _report_progress(self) -> None:
        if self.progress is None:
            return
        done = len(self.reports)
        self.progress(
            SolveProgress(
                done,
                len(self.samples),
                time.perf_counter() - self.begin,
                done - self.found,
                self.estimate,
            )
        )
