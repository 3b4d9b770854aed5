"""Session: the live solve of a reduced model (paper, sec. 6.2)."""

from __future__ import annotations

import time
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Iterator
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..arguments import is_number, is_whole, require_dimension, require_type, shown
from ..certificate import Certificate, ResidualProbe, ResidualSample, residual_probe
from .certify import certify
from .display_shapes import DisplayShapes, Vertices
from .frame_report import FrameReport
from .lowest_of import lowest_of
from .not_pickled import NotPickled
from .polish import Polished, Polisher
from .session_options import MINIMIZERS, check_options
from .time_steps import Model, TimeSteps

FloatArray = NDArray[np.float64]


class Session(TimeSteps[Model], NotPickled, ABC):
    """Base class of the sessions of all problems.

    `PosingSession` moves handles, `BlendingSession` sets weights; `model.session()` makes either.
    Each change solves the reduced problem, starting from the last frame's shape.

    Parameters
    ----------
    model : ReducedModel
    tolerance : float, default 1e-7 for posing, 1e-9 for blending
        eps of the termination tests (paper, sec. 6.2), which are relative to a strain of 10 % and
        a displacement of a tenth of the diagonal.
    max_iterations, max_evaluations : int, default 300 and 500
        Bounds on the work of one frame: steps, and evaluations of the energy.
    minimizer : "newton" or "bfgs", default "newton", but "bfgs" for a cubature
        Newton's method with the exact Hessian, shifted where that is not positive definite; or the
        paper's BFGS, whose first approximation is the inverse Hessian at tau (sec. 6.2), or that of
        the last frame if the energy is a cubature. With the energy of all tets, BFGS begins with
        the Hessian at its start, and computes another after 40 iterations.
    precision : "double" or "single", default "double"
        Precision of the stored coefficients. Single takes half of the memory, and less time where
        the coefficients do not fit into the second-level cache (d = 60 and more). Each coefficient
        is rounded to 6e-8 of its size; all arithmetic is in double precision.

    Raises
    ------
    ValueError
        For a tolerance or bound that is not positive and finite, or an unknown minimizer or
        precision.
    """

    default_tolerance = 1e-7

    def __init__(
        self,
        model: Model,
        *,
        tolerance: float | None = None,
        max_iterations: int = 300,
        max_evaluations: int = 500,
        minimizer: str | None = None,
        precision: str = "double",
    ) -> None:
        tolerance = self.default_tolerance if tolerance is None else tolerance
        if minimizer is None:  # the Hessian of a cubature costs d / 4 times its gradient
            minimizer = "newton" if model.cubature is None else "bfgs"
        check_options(tolerance, max_iterations, max_evaluations, minimizer, precision)
        self.model = model
        self.tolerance = tolerance
        self.max_iterations = max_iterations
        self.max_evaluations = max_evaluations
        self.minimizer = minimizer
        self._loop: Any = self._make_loop(single=precision == "single")
        self._display = DisplayShapes(model.subspace)
        self._polisher: Polisher | None = None
        self._probe: tuple[ResidualSample, ResidualProbe] | None = None
        self.reset()

    def __repr__(self) -> str:
        return f"{type(self).__name__}(dimension {self.dimension}, {self.model!r})"

    @property
    def dimension(self) -> int:
        """Number of coordinates that are solved for: at first all of the model's.

        A smaller dimension is faster and less accurate, as with `model.leading(dimension)`. A new
        dimension keeps the leading coordinates of the shape; added coordinates are zero until the
        next solve. ValueError unless it is between 1 and the model's dimension.
        """
        dimension: int = self._loop.dimension
        return dimension

    @dimension.setter
    def dimension(self, dimension: int) -> None:
        require_dimension("Session", dimension, self.model.dimension)
        self._loop.dimension = dimension

    @property
    def q(self) -> FloatArray:
        """Reduced coordinates of the current shape, (dimension,)."""
        q: FloatArray = self._loop.q
        return q

    def hessian(self) -> FloatArray:
        """Hessian (d, d) of the reduced objective at the current shape and parameters."""
        hessian: FloatArray = self._loop.hessian(self.q)
        return hessian

    @property
    def vertices(self) -> FloatArray:
        """Vertices tau + U q of the current shape, (n, 3), in the mesh's length unit."""
        return self._placed(self.model.subspace.shape(self.q).reshape(-1, 3))

    @property
    def positions(self) -> NDArray[np.float32]:
        """`vertices` for the screen: faster, in single precision, see `DisplayShapes`."""
        return self._placed(self._display.shape(self.q).reshape(-1, 3))

    def solve(self) -> FrameReport:
        """Solves for the current handles or weights, from the current shape."""
        begin = time.perf_counter()
        self._movement = None  # a body that is solved for statically no longer moves
        report = self._loop.solve(**self._solver_options())
        return FrameReport.of(report, time.perf_counter() - begin)

    def _solver_options(self) -> dict[str, Any]:
        return {
            "method": MINIMIZERS[self.minimizer],
            "tolerance": self.tolerance,
            "max_iterations": self.max_iterations,
            "max_evaluations": self.max_evaluations,
            "value_scale": self.model.value_scale,
            "coordinate_scale": self.model.coordinate_scale,
        }

    def polish(
        self,
        *,
        iterations: int = 10,
        tolerance: float | None = None,
        should_stop: Callable[[], bool] | None = None,
    ) -> Polished:
        """Improves the current shape by a few iterations in the full space, such as after a drag.

        The session does not change: its q, `vertices` and next frames stay in the subspace. Only
        the result has the improved shape.

        Parameters
        ----------
        iterations : int, default 10
            Largest number of iterations. On unseen samples ten leave two thirds of the error on the
            Dragon, a third on the armadillo, a seventh on the helix, and a twentieth on surfaces of
            a lion and a centaur, blended as rigidly as possible.
        tolerance : float, optional
            Converged when twice the decrease that the solver's model predicts is below this share
            of the objective. Default: that of the problem's snapshots.
        should_stop : callable() -> bool, optional
            Called about ten times a second. Once it returns True, iterations stop: the result has
            the best shape so far and the status cancelled.

        Returns
        -------
        Polished

        Raises
        ------
        ValueError
            For a number of iterations that is negative or not a whole number, a tolerance that is
            not positive and finite, or a `should_stop` that is not a function.
        KeyboardInterrupt
            On Ctrl-C, within the time of one iteration.

        Notes
        -----
        The cost grows with the mesh: on the Dragon (121k tets) about 15 ms per iteration. The first
        call computes the scalar factor, 0.1 to 0.3 s there, unless the problem has solved samples.
        """
        tolerance = self.model.problem.solving.tolerance if tolerance is None else tolerance
        if not (is_whole(iterations) and is_number(tolerance)):
            raise ValueError(
                f"polish: iterations is {shown(iterations)} and tolerance {shown(tolerance)}, but "
                "must be a whole number and a number"
            )
        cure = "give a function without arguments, or None"
        require_type("polish", "should_stop", should_stop, Callable | None, cure)
        if iterations < 0 or not 0 < tolerance < np.inf:
            raise ValueError(
                f"polish: iterations {iterations} must not be negative, and tolerance {tolerance} "
                "must be positive and finite"
            )
        q = self.q
        if self._polisher is None or self._polisher.dimension != len(q):
            self._polisher = Polisher(self.model.problem, self.model.subspace.leading(len(q)))
        return self._polisher.polish(
            q,
            self._inputs(),
            self.hessian() if self._polisher.needs_hessian else None,
            self._placed,
            iterations=iterations,
            tolerance=tolerance,
            should_stop=should_stop,
        )

    def certificate(self, *, confidence: float = 0.9, thorough: bool = False) -> Certificate:
        """How far the current shape is from the full solution, by a calibrated estimate.

        The shape must be at rest: a body that swings is not near a static solution.

        Parameters
        ----------
        confidence : float, default 0.9
            Confidence of the upper bounds.
        thorough : bool, default False
            Uses the distance that a polish moves the shape instead of the residual at sampled
            vertices: more accurate, at the cost of `polish`.

        Raises
        ------
        ValueError
            If the confidence is not between 0 and 1, if the model is not calibrated or was
            calibrated for another dimension, or if the confidence needs more samples than the
            calibration had. The message names the cure.
        """
        return certify(self, confidence=confidence, thorough=thorough)

    def residual(self, sample: ResidualSample) -> float:
        """Norm of the full objective's residual at the current shape, from a few vertices.

        It estimates sqrt(g^T D^-1 g), see `ResidualSample`. After the first call with a sample, the
        cost does not grow with the mesh.
        """
        cure = "give a ResidualSample"
        require_type("residual", "sample", sample, ResidualSample, cure)
        if self._probe is None or self._probe[0] is not sample:
            model = self.model
            self._probe = sample, residual_probe(model.problem, model.subspace, sample)
        return self._probe[1].norm(self.q, self._state())

    def solve_anew(self) -> FrameReport:
        """Solves from the current shape, from tau, and from the best samples.

        A drag follows one minimum; far from rest there may be others. `solve_anew` takes the lowest
        minimum that the starts lead to. The report's `start` names its start: "last frame" unless
        another minimum is lower than that of the drag by ten times what the tolerance resolves. The
        best samples are the one with the lowest energy and, for posing, the shape from which a jump
        starts. The cost is that of about ten to fifty frames.
        """
        return self._lowest_of([("last frame", self.q), *self._known_starts()])

    def _lowest_of(self, starts: Iterable[tuple[str, FloatArray]]) -> FrameReport:
        resolved = 10.0 * self.tolerance
        return lowest_of(self._loop, self.solve, starts, resolved, self.model.value_scale)

    @property
    @abstractmethod
    def outside(self) -> tuple[str, ...]:
        """Names of the handles or poses outside the domain in which the model was sampled.

        There the reduced solution may be far from the full one.
        """

    @abstractmethod
    def set_parameters(self, parameters: ArrayLike) -> FrameReport:
        """Sets a parameter vector (p,) of the problem, even outside its domain, and solves."""

    @abstractmethod
    def reset(self) -> None:
        """Returns to tau."""

    def _known_starts(self) -> Iterator[tuple[str, FloatArray]]:
        """tau, and the training sample of the lowest energy, as coordinates."""
        yield "tau", np.zeros(self.dimension)
        samples = self.model.training_coordinates[:, : self.dimension]
        if len(samples):
            values = [self._loop.value_and_gradient(q)[0] for q in samples]
            yield "sample", samples[np.nanargmin(values)]

    @abstractmethod
    def _state(self) -> FloatArray:
        """The parameters of the frame: offsets (h, 3, 4) of the handles, or weights."""

    @abstractmethod
    def _inputs(self) -> FloatArray:
        """The same parameters as inputs of the problem's compiled system, (input_size,)."""

    @abstractmethod
    def _placed(self, vertices: Vertices) -> Vertices:
        """The vertices (n, 3) of a shape, moved to where the session shows it."""

    @abstractmethod
    def _make_loop(self, *, single: bool) -> Any:
        """The compiled live loop of the model, with coefficients in single or double precision."""
