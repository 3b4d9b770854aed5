"""ReducedModel: everything that a live solve needs, at a cost independent of the mesh."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ..certificate import ErrorEstimator
from ..cubature import BlendedSum, Cubature
from ..energy import rigidities
from ..mesh import EmbeddedSurface, MirrorPlane, ShellMesh
from ..problem import Problem
from ..subspace import AffineSubspace

if TYPE_CHECKING:
    from ..page import NotebookPage
    from ..session import Session

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True, eq=False)
class ReducedModel(ABC):
    """A problem restricted to a subspace: a `PosingModel` or an `InterpolationModel`.

    problem : PosingProblem or InterpolationProblem
    subspace : AffineSubspace, attached to the problem's tau
    surface : EmbeddedSurface, shown by pages and files: the user's, or the boundary of the tets,
        or the triangles of a shell
    training_parameters : (k, p), parameters of the solutions that the subspace was made from, or
        (0, p)
    training_coordinates : (k, d), coordinates of their projections, or (0, d)
    provenance : how the model was made: versions, seeds, options, timings
    error_estimator : ErrorEstimator of `calibrate`, for `Session.certificate`
    """

    problem: Problem
    subspace: AffineSubspace
    surface: EmbeddedSurface
    training_parameters: FloatArray
    training_coordinates: FloatArray
    provenance: dict[str, Any] = field(default_factory=dict)
    error_estimator: ErrorEstimator | None = None

    @property
    def dimension(self) -> int:
        """Dimension d of the subspace."""
        return self.subspace.dimension

    @property
    def up(self) -> str:
        """Axis that points up in pages and pictures: `provenance["up"]`.

        If the record names none, the axis of the surface's file (`SurfaceFile.up`), or z without a
        file.
        """
        axis = self.provenance.get("up")
        if axis in ("x", "y", "z"):
            return str(axis)
        return "z" if self.surface.source is None else self.surface.source.up

    @property
    def mirror_plane(self) -> MirrorPlane | None:
        """The plane of `provenance["mirror"]`, {"normal", "point"}; None without that entry."""
        record = self.provenance.get("mirror")
        try:
            return MirrorPlane(**record) if isinstance(record, dict) else None
        except (TypeError, ValueError):  # the record comes from a file and may hold anything
            return None

    @cached_property
    def value_scale(self) -> float:
        """Unit of energy for the termination tests, as of a shear of 10 %: 0.01 mu * volume.

        For moduli that differ from tet to tet, the sum over all tets. A shell bends more easily
        than it shears, so its unit is the energy of bending to a curvature of sqrt(2) over the
        diagonal. Cached, since every frame needs it and the sum runs over the whole mesh.
        """
        mu, mesh = self.problem.material.mu, self.problem.mesh
        if isinstance(mesh, ShellMesh):
            bending = rigidities(mesh, self.problem.material)
            return float(bending @ mesh.areas) / mesh.diagonal**2
        if np.ndim(mu) == 0:
            return float(0.01 * mu * mesh.volume)
        return float(0.01 * (mu @ mesh.volumes))

    @property
    def coordinate_scale(self) -> float:
        """Unit of q: the M-norm of a displacement by a tenth of the diagonal everywhere."""
        mesh = self.problem.mesh
        return float(0.1 * mesh.diagonal * np.sqrt(mesh.volume))

    @property
    @abstractmethod
    def cubature(self) -> Cubature | BlendedSum | None:
        """The reduced elastic energy where it is a sum over few tets; None where it is exact."""

    @abstractmethod
    def leading(self, dimension: int) -> ReducedModel:
        """The model on the first coordinates; nothing is computed anew.

        Projections never get worse with more dimensions, but reduced solutions may: with several
        stiff handles errors can peak at 20 or 30, see docs/notes/basis-order.md.
        """

    @abstractmethod
    def session(self, **options: Any) -> Session[Any]:
        """A live session; options as for `Session`."""

    def save(self, path: str | Path) -> Path:
        """Writes a .snapspace file, as `save_model`."""
        from ..model_file import save_model

        return save_model(self, path)

    def show(self, *, title: str = "", up: str | None = None, height: int = 600) -> NotebookPage:
        """The page in which the model is posed or blended, as the last line of a notebook cell.

        Parameters
        ----------
        title : str, optional
            Heading of the page.
        up : "x", "y" or "z", default the model's own
            Axis that points up at first.
        height : int, default 600
            In pixels; 100 or more, else ValueError.

        Warns
        -----
        UserWarning
            If the output has more than 10 MB, which some connections to a remote kernel cannot
            carry.
        """
        from ..page import NotebookPage

        return NotebookPage(self, title=title, up=up, height=height)

    def __repr__(self) -> str:
        return f"{type(self).__name__}(dimension {self.dimension}, {self.problem!r})"
