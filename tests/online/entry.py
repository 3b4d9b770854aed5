"""A session behind the C functions."""

from __future__ import annotations

import ctypes
from typing import Any

import numpy as np
from numpy.typing import NDArray

import snapspace as ss
from snapspace import InterpolationModel, PosingModel, ReducedModel
from snapspace.certificate.probe_pins import ProbePins
from snapspace.cubature import BlendedStars, LocalRows
from snapspace.energy import ShellMaterial

from .library import Basis, Clusters, Cubature, Material, Options, Report, Stars, address

FloatArray = NDArray[np.float64]


def material(given: ss.Material | ShellMaterial) -> Material:
    return Material(given.kind.encode(), len(given.moduli), address(given.moduli))


def cubature(elastic: ss.Cubature) -> Cubature:
    """The struct of a cubature; it refers to the arrays."""
    rows, clusters = elastic.stored_rows, Clusters()
    numbers = rows.rows if isinstance(rows, LocalRows) else rows
    if isinstance(rows, LocalRows):
        clusters = Clusters(len(rows.sizes), address(rows.sizes), address(rows.modes))
    arrays = address(numbers), address(elastic.weights)
    return Cubature(len(elastic.tets), *arrays, material(elastic.material), clusters)


def pin_arrays(pins: ProbePins) -> dict[str, NDArray[Any]]:
    """Fields of both structs of probes."""
    return {
        "pinned": pins.pinned,
        "pin_handles": pins.handles,
        "pulls": pins.pulls,
        "arms": np.ascontiguousarray(pins.arms),
    }


def stars(blends: BlendedStars) -> Stars:
    names = ("rows", "weights", "origins", "forms")
    arrays = {name: address(getattr(blends, name)) for name in names}
    size = {"poses": blends.poses, "stars": len(blends.tets)}
    return Stars(**size, **arrays, material=material(blends.material))


class Entry:
    """A session behind the C functions."""

    def __init__(self, library: ctypes.CDLL, model: ReducedModel) -> None:
        self.library, self.model = library, model
        self.modes = np.ascontiguousarray(model.subspace.basis.T)
        self.basis = Basis(
            self.modes.shape[1] // 3, address(model.subspace.tau), address(self.modes)
        )
        error, d = ctypes.c_int(7), model.dimension
        if isinstance(model, PosingModel):
            elastic = model.elastic
            if isinstance(elastic, ss.Cubature):
                create = library.snapspace_create_posing_cubature
                first = self.reference(cubature(elastic))
            else:
                create, first = library.snapspace_create_posing, address(elastic.coefficients)
            handles = [address(array) for array in vars(model.handles).values()]
            made = create(
                d, len(model.problem.handles), first, *handles, self._basis(), self.reference(error)
            )
        else:
            assert isinstance(model, InterpolationModel)
            blends, count = model.blends, len(model.problem.poses)
            end = self._basis(), self.reference(error)
            if isinstance(blends, BlendedStars):
                given = self.reference(stars(blends))
                made = library.snapspace_create_blending_stars(d, given, *end)
            else:
                coefficients = address(blends.coefficients)
                made = library.snapspace_create_blending(d, count, coefficients, *end)
        assert error.value == 0
        self.session = ctypes.c_void_p(made)

    def _basis(self) -> Any:
        return ctypes.byref(self.basis)

    @staticmethod
    def reference(value: Any) -> Any:
        return ctypes.byref(value)

    def call(self, name: str, *arguments: Any) -> int:
        code: int = getattr(self.library, f"snapspace_{name}")(self.session, *arguments)
        return code

    def residual(self) -> float:
        """The residual of the present shape, if a probe is set."""
        found = ctypes.c_double(np.nan)
        assert self.call("residual", self.reference(found)) == 0
        return found.value

    def solve(self, method: int = 0, **changes: Any) -> Report:
        options = Options(
            method, 1e-10, self.model.value_scale, self.model.coordinate_scale, 300, 500
        )
        for key, value in changes.items():
            setattr(options, key, value)
        report = Report()
        assert self.call("solve", self.reference(options), self.reference(report)) == 0
        return report

    def read(self, name: str, size: int) -> FloatArray:
        array = np.full(size, np.nan)
        assert self.call(name, address(array)) == 0
        return array
