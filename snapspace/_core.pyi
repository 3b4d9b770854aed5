"""The compiled core: the computations of snapspace that must be fast."""

from collections.abc import Sequence
import enum
from typing import Annotated, overload

import numpy
from numpy.typing import NDArray


lane_count: int

class VertexStars:
    """The stars of a surface: the elements of its ARAP energy."""

    def corners(self) -> tuple[NDArray[numpy.int32], NDArray[numpy.int32], NDArray[numpy.float64]]:
        """
        First corners (s + 1,), vertices (c,) and gradients (c, 3). The displacement gradient of a star is the sum of u (x) gradient over its corners.
        """

    def triangles(self) -> tuple[NDArray[numpy.int32], NDArray[numpy.int32], NDArray[numpy.float64]]:
        """
        First triangles (s + 1,), triangles (t,) and shares (t,). A triangle's weight in a star is its share times a third of its area times its modulus.
        """

    def numbers(self) -> NDArray[numpy.float64]:
        """Rows of the density "shell-arap" (s, 12), with modulus one."""

    def areas(self) -> NDArray[numpy.float64]:
        """Sums of the hats times a third of the area around each vertex, (s,)."""

    def weights(self) -> NDArray[numpy.float64]:
        """The same sums with areas times moduli, (s,)."""

    def couplings(self) -> tuple[NDArray[numpy.int32], NDArray[numpy.int32], NDArray[numpy.float64]]:
        """
        First neighbours (n + 1,), vertices (e,) and couplings (e,). The Dirichlet energy is the sum of coupling * u_i . (u_j - u_i) over all vertices and their neighbours.
        """

class StarHats:
    """
    Weights of the vertices in the stars of a surface. They sum to one at every vertex.
    """

    def __len__(self) -> int: ...

    def rows(self) -> tuple[NDArray[numpy.int32], NDArray[numpy.int32], NDArray[numpy.float64]]:
        """
        Starts of the rows (s + 1,), vertices (w,) and weights (w,). The first vertex of a row is the center of the star.
        """

    def __getstate__(self) -> tuple[list[int], list[int], list[float]]: ...

    def __setstate__(self, arg: tuple[Sequence[int], Sequence[int], Sequence[float]], /) -> None: ...

def star_hats(shapes: NDArray[numpy.float64], triangles: NDArray[numpy.int32], radius: float) -> StarHats:
    """
    Stars of a surface. Their centers are at least a radius apart along edges, and every vertex is less than a radius from a center.
    """

class Material:
    """
    An energy density, given by its name, and its moduli: one row (1, k), or one row per tet.
    """

    def __init__(self, kind: str, moduli: NDArray[numpy.float64], hats: StarHats | None = None) -> None: ...

    @property
    def kind(self) -> str: ...

    @property
    def rows(self) -> int: ...

def material_moduli() -> dict[str, list[str]]:
    """
    Names of the moduli of every density of solids, in the order of the entries of a row.
    """

def shell_moduli(poses: NDArray[numpy.float64], elements: NDArray[numpy.int32], kind: str, moduli: NDArray[numpy.float64]) -> NDArray[numpy.float64]:
    """
    Rows of a shell's density (k, m, 15) with each of several poses (k, n, 3) as the rest shape. A row has the element's mu, lam and bending from `moduli` (m, 3), and then the numbers that describe its rest shape.
    """

class Projection(enum.Enum):
    """How Newton's method projects the Hessian of a tet."""

    none = 0

    stretches = 1

    clamp = 2

    absolute = 3

class ElasticEnergy:
    """
    Elastic energy of a mesh as a function of displacements u (3n,) from rest.
    """

    def __init__(self, vertices: NDArray[numpy.float64], tets: NDArray[numpy.int32], material: Material) -> None: ...

    def value_and_gradient(self, u: NDArray[numpy.float64]) -> tuple[float, NDArray[numpy.float64]]:
        """Energy and its gradient (3n,)."""

    def tet_stresses(self, u: NDArray[numpy.float64]) -> tuple[NDArray[numpy.float64], NDArray[numpy.float64]]:
        """
        Volume times first Piola-Kirchhoff stress (m, 9) and energy (m,) of each element: a tet, a triangle or a hinge, or the star of a vertex.
        """

    def some_tet_stresses(self, u: NDArray[numpy.float64], which: NDArray[numpy.int32]) -> tuple[NDArray[numpy.float64], NDArray[numpy.float64]]:
        """
        `tet_stresses` for some elements (c,): stresses (c, 9) and energies (c,).
        """

    def stars(self) -> VertexStars:
        """The stars of an as-rigid-as-possible surface."""

    def hessian_product(self, u: NDArray[numpy.float64], v: NDArray[numpy.float64]) -> NDArray[numpy.float64]:
        """Hessian at u times v (3n,), without forming the Hessian."""

    def hessian_blocks(self, u: NDArray[numpy.float64], *, projection: Projection = Projection.none, threshold: float = 0.0) -> tuple[NDArray[numpy.int32], NDArray[numpy.int32], NDArray[numpy.float64]]:
        """
        Hessian at u, projected tet by tet, as block rows: (row_start (n+1,), columns (b,), blocks (b,3,3)). Only Projection.stretches uses the threshold.
        """

    def lane_values_and_gradients(self, shapes: NDArray[numpy.float64], *, single: bool = False) -> tuple[NDArray[numpy.float64], NDArray[numpy.float64]]:
        """
        Energies (k,) and gradients (k, 3n) at up to lane_count displacements (k, 3n), one per lane; twice as many in single precision.
        """

    def scalar_diagonal(self) -> NDArray[numpy.float64]:
        """
        Diagonal (n,) of the scalar matrix that replaces the Hessian for each of x, y and z.
        """

    def inverted_tets(self, u: NDArray[numpy.float64]) -> int:
        """Number of elements with det F <= 0."""

def minimum_degree(starts: NDArray[numpy.int32], rows: NDArray[numpy.int32]) -> NDArray[numpy.int32]:
    """
    Elimination order (n,) by minimum degree for a symmetric pattern, given by its columns.
    """

def nested_dissection(starts: NDArray[numpy.int32], rows: NDArray[numpy.int32]) -> NDArray[numpy.int32]:
    """
    Elimination order (n,) by nested dissection for a symmetric pattern, given by its columns.
    """

class ScalarFactor:
    """
    Cholesky factor of a sparse symmetric matrix (n, n), given by its columns with both triangles. Solves are for x, y and z at once.
    """

    def __init__(self, starts: NDArray[numpy.int32], rows: NDArray[numpy.int32], values: NDArray[numpy.float64]) -> None: ...

    @staticmethod
    def in_order(starts: NDArray[numpy.int32], rows: NDArray[numpy.int32], values: NDArray[numpy.float64], order: NDArray[numpy.int32]) -> ScalarFactor:
        """The factor for a given elimination order (n,)."""

    @property
    def nonzeros(self) -> int: ...

    def solve(self, right_hand_side: NDArray[numpy.float64]) -> NDArray[numpy.float64]:
        """Solution for one right-hand side (1, 3n)."""

    def solve_lanes(self, right_hand_sides: NDArray[numpy.float64]) -> NDArray[numpy.float64]:
        """Solutions for up to lane_count right-hand sides (k, 3n), one per lane."""

    def solve_single_lanes(self, right_hand_sides: NDArray[numpy.float64]) -> NDArray[numpy.float64]:
        """
        `solve_lanes` in single precision, for up to twice as many right-hand sides.
        """

class FaceTree:
    """
    The triangles (f, 3) of a surface with vertices (n, 3), for searches of closest faces, and for winding numbers.
    """

    def __init__(self, vertices: NDArray[numpy.float64], faces: NDArray[numpy.int32]) -> None: ...

    def closest(self, points: NDArray[numpy.float64], limit: float, threads: int = 0) -> tuple[NDArray[numpy.int32], NDArray[numpy.float64], NDArray[numpy.float64]]:
        """
        The face closest to each point (k, 3), the first of equally close ones, or -1 if none is within the limit; its distance, or inf; and the closest point on it (k, 3), or nan. threads: 0 for all.
        """

    def windings(self, points: NDArray[numpy.float64], threads: int = 0) -> NDArray[numpy.int32]:
        """
        How often a closed surface encloses each point (k, 3). threads: 0 for all.
        """

class InverseKind(enum.Enum):
    """How the inverse of a scalar matrix is applied."""

    automatic = 0

    factor = 1

    cycle = 2

class TwoGridCycle:
    """
    Two-grid cycle that approximates the inverse of a sparse symmetric matrix (n, n), given by its columns with both triangles. It is applied to x, y and z at once.
    """

    def __init__(self, starts: NDArray[numpy.int32], rows: NDArray[numpy.int32], values: NDArray[numpy.float64]) -> None: ...

    @property
    def coarse_size(self) -> int: ...

    def lowest_eigenvalue(self, starts: NDArray[numpy.int32], rows: NDArray[numpy.int32], values: NDArray[numpy.float64]) -> float:
        """
        Estimate from above of the lowest eigenvalue of cycle * matrix. The matrix must be the one that the cycle was made from.
        """

    def apply(self, right_hand_side: NDArray[numpy.float64]) -> NDArray[numpy.float64]:
        """Cycle times one right-hand side (1, 3n)."""

    def apply_lanes(self, right_hand_sides: NDArray[numpy.float64]) -> NDArray[numpy.float64]:
        """Cycle times up to lane_count right-hand sides (k, 3n), one per lane."""

    def apply_single_lanes(self, right_hand_sides: NDArray[numpy.float64]) -> NDArray[numpy.float64]:
        """
        `apply_lanes` in single precision, for up to twice as many right-hand sides.
        """

class MassProducts:
    """
    Inner products of displacements (3n,) with respect to a scalar matrix (n, n), given row by row. Only one thread may use it at a time.
    """

    def __init__(self, starts: NDArray[numpy.int32], columns: NDArray[numpy.int32], values: NDArray[numpy.float64]) -> None: ...

    def multiply(self, rows: Sequence[NDArray[numpy.float64]], offset: NDArray[numpy.float64] | None, others: Sequence[NDArray[numpy.float64]], *, threads: int) -> NDArray[numpy.float64]:
        """Products (i, j) of rows[i] + offset with M (x) I3 times others[j]."""

def combine_rows(rows: Sequence[NDArray[numpy.float64]], size: int, weights: NDArray[numpy.float64], *, threads: int) -> NDArray[numpy.float64]:
    """Combinations (j, size) of i rows (size,): weights (j, i) times rows."""

class SolveStatus(enum.Enum):
    """How a full-space solve ended."""

    converged = 0

    max_iterations = 1

    line_search_failed = 2

    not_finite = 3

    cancelled = 4

class SolveReport:
    """How the solve of one sample ended."""

    @property
    def status(self) -> SolveStatus: ...

    @property
    def iterations(self) -> int: ...

    @property
    def evaluations(self) -> int: ...

    @property
    def value(self) -> float:
        """Objective at the returned shape."""

    @property
    def gradient_norm(self) -> float:
        """Euclidean norm of its gradient."""

    @property
    def decrement(self) -> float:
        """
        -g.d of the last direction d: twice the decrease that the quadratic model predicts.
        """

    @property
    def seconds(self) -> float:
        """Wall time from the start to the end of the solve."""

    @property
    def inverted_tets(self) -> int: ...

class SolveControl:
    """Shared with a running solve: cancels it, and counts finished samples."""

    def __init__(self) -> None: ...

    def cancel(self) -> None: ...

    @property
    def cancelled(self) -> bool: ...

    @property
    def finished(self) -> int: ...

class Solution:
    """A solved sample."""

    @property
    def id(self) -> int: ...

    @property
    def report(self) -> SolveReport: ...

    @property
    def shape(self) -> NDArray[numpy.float64]:
        """(3n,) displacement, in the memory of the solution."""

class SampleQueue:
    """Passes samples to the threads that solve them, and solutions back."""

    def __init__(self) -> None: ...

    def close(self) -> None:
        """Declares that no more samples will come."""

    def running(self) -> list[tuple[int, int]]:
        """Samples that are being solved, with their evaluations so far."""

    def collect(self, into: list[Solution], seconds: float) -> None:
        """
        Appends the solutions since the last call to a list; waits up to this many seconds for one. They are not returned, because a KeyboardInterrupt would lose a returned list.
        """

class Batch:
    """Solutions of one call."""

    @property
    def shapes(self) -> NDArray[numpy.float64]:
        """(samples, 3n) displacements from rest."""

    @property
    def reports(self) -> list[SolveReport]: ...

    @property
    def linear_iterations(self) -> int:
        """Conjugate gradient iterations of all samples together (Newton only)."""

class SampleSystem:
    """Data that all samples of a problem share, with the scalar factor."""

    @property
    def inverse(self) -> InverseKind:
        """How the inverse of the scalar matrix is applied."""

    @property
    def inverse_products(self) -> int: ...

    @property
    def lowest_eigenvalue(self) -> float | None:
        """
        Lowest eigenvalue of cycle * scalar matrix if a cycle was made, even if unused.
        """

    @property
    def input_size(self) -> int: ...

    @property
    def patches(self) -> int:
        """
        Number of patches whose rigid motions are in the seed; 0 for systems without them.
        """

    def precondition(self, vector: NDArray[numpy.float64]) -> NDArray[numpy.float64]:
        """
        The inverse of the scalar matrix, or its approximation, applied to x, y and z.
        """

    def value_and_gradient(self, u: NDArray[numpy.float64], inputs: NDArray[numpy.float64]) -> tuple[float, NDArray[numpy.float64]]:
        """Objective at u (3n,) for inputs (input_size,), and its gradient."""

    def evaluate(self, shapes: NDArray[numpy.float64], inputs: NDArray[numpy.float64], *, threads: int = 0) -> tuple[NDArray[numpy.float64], NDArray[numpy.float64]]:
        """
        Objectives (k,) at displacements (k, 3n) for inputs (k, input_size), and their gradients (k, 3n). A pack computes several of them.
        """

    def evaluate_in_pack(self, shapes: NDArray[numpy.float64], inputs: NDArray[numpy.float64], *, width: int, single: bool) -> tuple[NDArray[numpy.float64], NDArray[numpy.float64], NDArray[numpy.float64], NDArray[numpy.float64]]:
        """
        As `evaluate`, in one pack of this width: objectives (k,), gradients (k, 3n), products (k,) of gradients and images, and images (k, 3n): the inverse Hessian's seed times gradients.
        """

    def put(self, queue: SampleQueue, id: int, input: NDArray[numpy.float64], start: NDArray[numpy.float64], *, coarse: CoarseSpace | None = None) -> None:
        """Puts a sample into a queue: input as for solve_fast, start (3n,)."""

    def serve_fast(self, queue: SampleQueue, expected: int, *, tolerance: float, max_iterations: int, threads: int, control: SolveControl, lanes: int = 16, single: bool = False, settling: float = 0.0, modes: SoftModes | None = None, coarse: CoarseSpace | None = None) -> None:
        """L-BFGS on the samples of a queue until it is closed and empty."""

    def serve_newton(self, queue: SampleQueue, expected: int, *, tolerance: float, max_iterations: int, threads: int, projection: Projection, threshold: float, control: SolveControl) -> None:
        """
        Newton's method on the samples of a queue until it is closed and empty.
        """

    def solve_fast(self, inputs: NDArray[numpy.float64], starts: NDArray[numpy.float64], *, tolerance: float, max_iterations: int, threads: int, control: SolveControl, lanes: int = 16, single: bool = False, settling: float = 0.0, modes: SoftModes | None = None, coarse: CoarseSpace | None = None) -> Batch:
        """
        Solves by L-BFGS; inputs (samples, input_size), starts (samples, 3n). With a coarse space, inputs are (samples, input_size + d * d): an input ends with the inverse Hessian (d, d) of its sample on that space.
        """

    def solve_newton(self, inputs: NDArray[numpy.float64], starts: NDArray[numpy.float64], *, tolerance: float, max_iterations: int, threads: int, projection: Projection, threshold: float, control: SolveControl) -> Batch:
        """
        Solves by Newton's method; inputs (samples, input_size), starts (samples, 3n).
        """

class PosingSystem(SampleSystem):
    """
    Data that all samples of a posing problem share, with the scalar factor. Inputs are the target displacements of the pinned vertices.
    """

    def __init__(self, vertices: NDArray[numpy.float64], tets: NDArray[numpy.int32], material: Material, pinned: NDArray[numpy.int32], weights: NDArray[numpy.float64], *, inverse: InverseKind = InverseKind.automatic) -> None: ...

class InterpolationSystem(SampleSystem):
    """
    Data that all samples of an interpolation problem share, with the scalar factor. Inputs are the weights of the poses, and displacements are from pose 0.
    """

    def __init__(self, poses: NDArray[numpy.float64], tets: NDArray[numpy.int32], material: Material) -> None: ...

    def adapted(self, shapes: NDArray[numpy.float64], weights: NDArray[numpy.float64]) -> InterpolationSystem:
        """
        The same system with an inverse that is adapted to solutions: those near displacements (k, 3n) for weights (k, poses).
        """

    def some_tet_stresses(self, u: NDArray[numpy.float64], weights: NDArray[numpy.float64], which: NDArray[numpy.int32]) -> tuple[NDArray[numpy.float64], NDArray[numpy.float64]]:
        """
        First Piola-Kirchhoff stress relative to pose 0, times the volume there, (c, 9), and energy (c,) of some tets (c,), each of which occurs once.
        """

    def tet_hessians(self, u: NDArray[numpy.float64], weights: NDArray[numpy.float64]) -> NDArray[numpy.float64]:
        """
        Hessian (m, 9, 9) of each tet's energy with respect to its displacement gradient relative to pose 0.
        """

    def scalar_hessians(self, u: NDArray[numpy.float64], weights: NDArray[numpy.float64]) -> NDArray[numpy.float64]:
        """
        The matrix (m, 3, 3) that replaces it for each row of the displacement gradient in the scalar factor.
        """

class SoftModes:
    """
    Soft modes of a posing system for the seed of L-BFGS: the lowest generalised eigenvectors of its Hessian at rest with respect to the scalar matrix. The scalar factor mistakes these deformations for stiff ones.
    """

    def __init__(self, system: PosingSystem) -> None: ...

    def modes(self, system: PosingSystem) -> NDArray[numpy.float64]:
        """
        Modes v (8, 3n) with v . A v = 1 for the scalar matrix A of the system.
        """

    @property
    def weights(self) -> list[float]:
        """The 8 weights of the modes in the seed; zero where no mode was found."""

class LinearResponse:
    """
    Linear responses of a posing system at rest: its displacements for small displacements (count, input_size) of the handles.
    """

    def __init__(self, system: PosingSystem, inputs: NDArray[numpy.float64]) -> None: ...

    def warped(self, system: PosingSystem, coordinates: NDArray[numpy.float64], inputs: NDArray[numpy.float64]) -> NDArray[numpy.float64]:
        """
        Displacements (samples, 3n) near the solutions for inputs (samples, input_size). Their linear parts are combinations of the responses with coefficients `coordinates` (samples, count).
        """

class CoarseSpace:
    """Modes (d, 3n) in the numbering of a system, in single precision."""

    def __init__(self, system: SampleSystem, modes: NDArray[numpy.float64]) -> None: ...

def polish(system: SampleSystem, coarse: CoarseSpace | None, inverse: NDArray[numpy.float64], input: NDArray[numpy.float64], start: NDArray[numpy.float64], *, tolerance: float, max_iterations: int, threads: int, control: SolveControl) -> Solution:
    """
    Runs L-BFGS on one sample from start (3n,), with a two-level seed. `inverse` (d, d) is the inverse of the Hessian on the coarse space; without a coarse space, as for surfaces with patches, it is (0, 0). If the solve is cancelled, the shape with the lowest objective so far is returned.
    """

class FitStatus(enum.Enum):
    """How the fit of one pose ended."""

    converged = 0

    max_iterations = 1

    stiffness_limit = 2

    line_search_failed = 3

    cancelled = 4

class FitReport:
    """How the fit of one pose ended."""

    @property
    def status(self) -> FitStatus: ...

    @property
    def stages(self) -> int: ...

    @property
    def iterations(self) -> int:
        """Newton steps of all stages."""

    @property
    def evaluations(self) -> int: ...

    @property
    def linear_iterations(self) -> int: ...

    @property
    def stiffness(self) -> float:
        """Stiffness of the last stage."""

    @property
    def deviation(self) -> float:
        """
        Root mean square distance between surface and target, weighted by area.
        """

    @property
    def seconds(self) -> float: ...

class FittingSystem:
    """Data that the fits of all poses of a mesh and its surface share."""

    def __init__(self, vertices: NDArray[numpy.float64], tets: NDArray[numpy.int32], corners: NDArray[numpy.int32], weights: NDArray[numpy.float64], areas: NDArray[numpy.float64]) -> None: ...

    def energy(self, u: NDArray[numpy.float64], *, stretch: float) -> tuple[float, NDArray[numpy.float64]]:
        """
        Symmetric Dirichlet energy at displacements u (3n,), and its gradient (3n,). The energy is infinite if a tet is inverted or reaches the largest stretch.
        """

    def projected_hessian_product(self, u: NDArray[numpy.float64], v: NDArray[numpy.float64], *, stretch: float) -> NDArray[numpy.float64]:
        """
        Product of v (3n,) and the Hessian of the energy at u, whose tets are projected to positive semi-definite matrices.
        """

    def fit(self, targets: NDArray[numpy.float64], start: NDArray[numpy.float64], *, deviation: float, first_stiffness: float, stretch: float, max_iterations: int, control: SolveControl) -> tuple[NDArray[numpy.float64], FitReport]:
        """
        Displacements (3n,) that move the surface points by the target displacements (s, 3), and a report. The fit starts at displacements (3n,) where the energy is finite.
        """

def mode_gradients(vertices: NDArray[numpy.float64], modes: NDArray[numpy.float64], tets: NDArray[numpy.int32], *, shell: bool = False, threads: int) -> NDArray[numpy.float32]:
    """
    Displacement gradients (r, 9, d), float32, of modes (d, 3n) in tets (r, 4), or in the triangles and hinges of a shell.
    """

def training_columns(rows: NDArray[numpy.float32], stresses: NDArray[numpy.float32], along: NDArray[numpy.float32], columns: NDArray[numpy.float32], *, threads: int) -> None:
    """
    Writes the products of all tets' forces and the directions `along` (s, d, k) to the first s * k entries of each row of columns.
    """

def quartic_coefficients(energy: ElasticEnergy, modes: NDArray[numpy.float64], *, threads: int) -> NDArray[numpy.float64]:
    """
    Packed symmetric coefficients (C(d+4, 4),) of the reduced elastic energy. Modes (d+1, 3n) are the offset, then the basis.
    """

class Method(enum.Enum):
    """How a reduced problem is solved."""

    newton = 0

    bfgs = 1

class Status(enum.Enum):
    """How a reduced solve ended."""

    converged = 0

    max_iterations = 1

    line_search_failed = 2

    not_finite = 3

    max_evaluations = 4

class Report:
    """How a reduced solve ended."""

    @property
    def status(self) -> Status: ...

    @property
    def iterations(self) -> int: ...

    @property
    def evaluations(self) -> int: ...

    @property
    def value(self) -> float: ...

    @property
    def gradient_norm(self) -> float: ...

def reconstruct(tau: NDArray[numpy.float64], modes: NDArray[numpy.float64], q: NDArray[numpy.float64]) -> NDArray[numpy.float64]:
    """tau + sum of q_i modes_i, (3n,)."""

class ShapeRows:
    """Shapes tau + U q of one basis for display, with modes in 16 bits."""

    def __init__(self, tau: NDArray[numpy.float64], modes: NDArray[numpy.float64]) -> None: ...

    @property
    def bytes(self) -> int:
        """Bytes that are read to compute a shape from all modes."""

    def shape(self, q: NDArray[numpy.float64], *, threads: int = 0) -> NDArray[numpy.float32]:
        """
        tau + U q (3n,) in single precision, where q has the first coordinates, on this many threads (0: as many as are worthwhile).
        """

class ReducedFunction:
    """A function of reduced coordinates q (d,)."""

    @property
    def dimension(self) -> int: ...

    def value_and_gradient(self, q: NDArray[numpy.float64]) -> tuple[float, NDArray[numpy.float64]]: ...

    def derivatives(self, q: NDArray[numpy.float64]) -> tuple[float, NDArray[numpy.float64], NDArray[numpy.float64]]:
        """Value, gradient and Hessian in one pass."""

class Quartic(ReducedFunction):
    """Polynomial of degree four with fully symmetric packed coefficients."""

    def __init__(self, dimension: int, coefficients: NDArray[numpy.float64], *, single: bool = False) -> None: ...

class LiveLoop:
    """Solves frame by frame; every solve starts from the last frame."""

    @property
    def q(self) -> NDArray[numpy.float64]: ...

    @q.setter
    def q(self, arg: NDArray[numpy.float64], /) -> None: ...

    @property
    def dimension(self) -> int: ...

    @dimension.setter
    def dimension(self, arg: int, /) -> None: ...

    def value_and_gradient(self, q: NDArray[numpy.float64]) -> tuple[float, NDArray[numpy.float64]]: ...

    def hessian(self, q: NDArray[numpy.float64]) -> NDArray[numpy.float64]: ...

    def solve(self, *, method: Method, tolerance: float, max_iterations: int, max_evaluations: int, value_scale: float, coordinate_scale: float) -> Report: ...

    def step(self, target: NDArray[numpy.float64], *, weight: float, method: Method, tolerance: float, max_iterations: int, max_evaluations: int, value_scale: float, coordinate_scale: float) -> tuple[Report, float]:
        """Report, and the objective before the step."""

    def softest(self) -> float:
        """The smallest curvature at q = 0, for handles at rest or equal weights."""

class PosingLoop(LiveLoop):
    """The live loop of posing: set offsets, then solve from the last frame."""

    def __init__(self, coefficients: NDArray[numpy.float64], K: NDArray[numpy.float64], L: NDArray[numpy.float64], S: NDArray[numpy.float64], *, single: bool = False) -> None: ...

    def set_offsets(self, offsets: NDArray[numpy.float64]) -> None: ...

class BlendingLoop(LiveLoop):
    """
    The live loop of blending: set weights, then solve from the last frame.
    """

    def __init__(self, dimension: int, coefficients: NDArray[numpy.float64], *, single: bool = False) -> None: ...

    def set_weights(self, weights: NDArray[numpy.float64]) -> None: ...

class TetRows:
    """
    Displacement gradients of tets as linear functions of all coordinates, or of the local coordinates of clusters.
    """

    @overload
    def __init__(self, rows: NDArray[numpy.float32]) -> None: ...

    @overload
    def __init__(self, sizes: NDArray[numpy.int32], rows: NDArray[numpy.float32], modes: NDArray[numpy.float32]) -> None: ...

class TetFunction(ReducedFunction):
    """A weighted sum over a few tets."""

    def curvatures(self, q: NDArray[numpy.float64]) -> NDArray[numpy.float32]:
        """
        Weighted Hessians (r, 9, 9) of the tets' energies with respect to their displacement gradients, float32.
        """

    def stresses(self, q: NDArray[numpy.float64]) -> NDArray[numpy.float32]:
        """Weighted stresses (r, 9) of the tets, float32."""

class Cubature(TetFunction):
    """Elastic energy as a weighted sum over a few tets."""

    def __init__(self, rows: TetRows, weights: NDArray[numpy.float64], material: Material) -> None: ...

class CubatureLoop(PosingLoop):
    """The live loop of posing with a cubature instead of a quartic."""

    def __init__(self, rows: TetRows, weights: NDArray[numpy.float64], material: Material, K: NDArray[numpy.float64], L: NDArray[numpy.float64], S: NDArray[numpy.float64]) -> None: ...

class BlendedFunction(TetFunction):
    """Blended energy of several poses."""

    def set_weights(self, weights: NDArray[numpy.float64]) -> None: ...

class BlendedCubature(BlendedFunction):
    """Blended energy of several poses as a weighted sum over a few tets."""

    def __init__(self, rows: TetRows, weights: NDArray[numpy.float64], material: Material, corners: NDArray[numpy.float64]) -> None: ...

class BlendedStars(BlendedFunction):
    """
    Blended ARAP energy of a surface: a weighted sum over a few stars plus a quadratic form.
    """

    def __init__(self, rows: NDArray[numpy.float32], weights: NDArray[numpy.float64], material: Material, origins: NDArray[numpy.float64], forms: NDArray[numpy.float64]) -> None: ...

class BlendedCubatureLoop(BlendingLoop):
    """The live loop of blending with a cubature instead of quartics."""

    def __init__(self, rows: TetRows, weights: NDArray[numpy.float64], material: Material, corners: NDArray[numpy.float64]) -> None: ...

class BlendedStarsLoop(BlendingLoop):
    """The live loop of blending with stars instead of quartics."""

    def __init__(self, rows: NDArray[numpy.float32], weights: NDArray[numpy.float64], material: Material, origins: NDArray[numpy.float64], forms: NDArray[numpy.float64]) -> None: ...

class ResidualProbe:
    """The gradient of the full objective at sampled vertices."""

    def norm(self, q: NDArray[numpy.float64], *, offsets: NDArray[numpy.float64] | None = None, weights: NDArray[numpy.float64] | None = None) -> float:
        """
        Estimate of the residual's norm, for offsets (h, 3, 4) or weights (k,).
        """

def element_probe(tau: NDArray[numpy.float64], modes: NDArray[numpy.float64], rests: NDArray[numpy.float64], tets: NDArray[numpy.int32], material: Material, sampled: NDArray[numpy.int32], weights: NDArray[numpy.float64], *, pinned: NDArray[numpy.int32], handles: NDArray[numpy.int32], pulls: NDArray[numpy.float64], arms: NDArray[numpy.float64]) -> ResidualProbe:
    """The probe of a body whose energy is a sum over independent elements."""

def star_probe(origins: NDArray[numpy.float64], modes: NDArray[numpy.float32], material: Material, part_stars: NDArray[numpy.int32], part_samples: NDArray[numpy.int32], part_vectors: NDArray[numpy.float64], weights: NDArray[numpy.float64], *, pinned: NDArray[numpy.int32], handles: NDArray[numpy.int32], pulls: NDArray[numpy.float64], arms: NDArray[numpy.float64]) -> ResidualProbe:
    """The probe of an as-rigid-as-possible surface."""

def peak_flops(*, single: bool, repeats: int = 20) -> float:
    """Peak floating-point operations per second of one thread in this build."""

def read_bandwidth(bytes: int, *, repeats: int = 20) -> float:
    """Bytes per second that one thread reads from an array of this size."""

def time_quartic(dimension: int, coefficients: NDArray[numpy.float64], q: NDArray[numpy.float64], *, single: bool = False, repeats: int = 1000) -> tuple[float, float]:
    """
    Seconds per evaluation of value and gradient, and of value, gradient and Hessian, on one thread.
    """

def time_reconstruct(tau: NDArray[numpy.float64], modes: NDArray[numpy.float64], q: NDArray[numpy.float64], *, repeats: int = 30) -> float:
    """Seconds to compute tau + sum of q_i modes_i on one thread."""

class PartTimes:
    """Seconds and floating-point operations of the parts of an L-BFGS step."""

    @property
    def kernel_seconds(self) -> float: ...

    @property
    def solve_seconds(self) -> float: ...

    @property
    def kernel_flops(self) -> float: ...

    @property
    def solve_flops(self) -> float: ...

def time_parts(system: PosingSystem, u: NDArray[numpy.float64], *, single: bool, repeats: int = 20) -> PartTimes:
    """
    Times of one thread with the widest pack, all lanes at displacement u (3n,).
    """

BUILDS: dict[str, int]
level: str

def available_levels() -> list[str]: ...
