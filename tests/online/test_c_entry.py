"""The plain C entry point gives what a session gives."""

from __future__ import annotations

import ctypes
import shutil
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import snapspace as ss
from snapspace import InterpolationModel, PosingModel, ReducedModel

from .library import CORE, Basis, Cubature, Options, Report, address, compiled, run

pytestmark = pytest.mark.skipif(
    not sys.platform.startswith("linux"), reason="compiles a shared library as on Linux"
)
FloatArray = NDArray[np.float64]
BAD_ARGUMENT, NOT_FINITE, NOT_DEFINITE, WRONG_KIND = -1, -2, -3, -4


@pytest.fixture(scope="module")
def library(tmp_path_factory: pytest.TempPathFactory) -> ctypes.CDLL:
    return compiled(tmp_path_factory.mktemp("online"))


def cubature(elastic: ss.Cubature) -> Cubature:
    material = elastic.material
    arrays = address(elastic.rows), address(elastic.weights)
    return Cubature(len(elastic.tets), *arrays, material.lam, material.mu)


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
                first = self._to(cubature(elastic))
            else:
                create, first = library.snapspace_create_posing, address(elastic.coefficients)
            handles = [address(array) for array in vars(model.handles).values()]
            made = create(
                d, len(model.problem.handles), first, *handles, self._basis(), self._to(error)
            )
        else:
            assert isinstance(model, InterpolationModel)
            count = len(model.problem.poses)
            made = library.snapspace_create_blending(
                d, count, address(model.coefficients), self._basis(), self._to(error)
            )
        assert error.value == 0
        self.session = ctypes.c_void_p(made)

    def _basis(self) -> Any:
        return ctypes.byref(self.basis)

    @staticmethod
    def _to(value: Any) -> Any:
        return ctypes.byref(value)

    def call(self, name: str, *arguments: Any) -> int:
        code: int = getattr(self.library, f"snapspace_{name}")(self.session, *arguments)
        return code

    def solve(self, method: int = 0, **changes: Any) -> Report:
        options = Options(
            method, 1e-10, self.model.value_scale, self.model.coordinate_scale, 300, 500
        )
        for key, value in changes.items():
            setattr(options, key, value)
        report = Report()
        assert self.call("solve", self._to(options), self._to(report)) == 0
        return report

    def read(self, name: str, size: int) -> FloatArray:
        array = np.full(size, np.nan)
        assert self.call(name, address(array)) == 0
        return array


@pytest.fixture
def posing(library: ctypes.CDLL, posing_model: PosingModel) -> Any:
    entry = Entry(library, posing_model)
    yield entry
    library.snapspace_destroy(entry.session)


@pytest.mark.parametrize(("method", "minimizer"), [(0, "newton"), (1, "bfgs")])
def test_a_drag_is_that_of_the_session(posing: Entry, method: int, minimizer: str) -> None:
    problem = posing.model.problem
    session = posing.model.session(tolerance=1e-10, minimizer=minimizer)
    for share in (0.2, 0.5, 0.9):
        w = share * problem.domain.half_widths
        offsets = np.ascontiguousarray(problem.offsets(w))
        assert posing.call("set_offsets", address(offsets)) == 0
        report, expected = posing.solve(method), session.pose(w)
        assert report.status == 0 and expected.converged
        assert report.value == pytest.approx(expected.value, rel=1e-9)
        assert 0 < report.iterations <= report.evaluations
        n = len(problem.mesh.vertices)
        vertices = posing.read("get_vertices", 3 * n).reshape(n, 3)
        assert vertices == pytest.approx(session.vertices, abs=1e-6)
        assert posing.read("get_q", 20) == pytest.approx(session.q, abs=1e-6)


def test_a_drag_with_a_cubature_is_that_of_the_session(
    library: ctypes.CDLL, cubature_model: PosingModel
) -> None:
    entry, problem = Entry(library, cubature_model), cubature_model.problem
    session, d = cubature_model.session(tolerance=1e-10), cubature_model.dimension
    taken = library.allocations()
    for dimension in (d, 8):
        assert entry.call("set_dimension", dimension) == 0
        session.dimension = dimension
        for share in (0.2, 0.5, 0.9):
            w = share * problem.domain.half_widths
            offsets = np.ascontiguousarray(problem.offsets(w))
            assert entry.call("set_offsets", address(offsets)) == 0
            report, expected = entry.solve(method=1), session.pose(w)
            assert report.status == 0 and expected.converged
            assert report.value == pytest.approx(expected.value, rel=1e-9)
            scale = cubature_model.coordinate_scale
            assert entry.read("get_q", dimension) == pytest.approx(session.q, abs=1e-5 * scale)
    assert entry.call("set_weights", address(np.ones(3))) == WRONG_KIND
    assert library.allocations() == taken
    library.snapspace_destroy(entry.session)


def test_blends_are_those_of_the_session(
    library: ctypes.CDLL, blending_model: InterpolationModel
) -> None:
    entry = Entry(library, blending_model)
    session = blending_model.session(tolerance=1e-10)
    for w in ([0.2, 0.7, 0.1], [0.0, 0.5, 0.5]):
        assert entry.call("set_weights", address(np.array(w))) == 0
        report = entry.solve()
        session.blend(w)
        assert report.status == 0
        assert report.value == pytest.approx(session.solve().value, rel=1e-8)
        assert entry.read("get_q", 12) == pytest.approx(session.q, abs=1e-5)
    assert entry.call("set_offsets", address(np.zeros(12))) == WRONG_KIND
    library.snapspace_destroy(entry.session)


def test_the_value_is_told_at_any_coordinates(posing: Entry) -> None:
    model, q = posing.model, np.linspace(-0.1, 0.1, 20)
    assert isinstance(model, PosingModel)
    w = 0.5 * model.problem.domain.half_widths
    offsets = np.ascontiguousarray(model.problem.offsets(w))
    posing.call("set_offsets", address(offsets))
    value = ctypes.c_double(np.nan)
    assert posing.call("value", address(q), posing._to(value)) == 0
    assert value.value == pytest.approx(model.value(q, offsets), rel=1e-9)
    assert not posing.read("get_q", 20).any(), "asking does not move the shape"
    assert posing.call("value", address(np.full(20, np.nan)), posing._to(value)) == NOT_FINITE
    assert posing.call("value", None, posing._to(value)) == BAD_ARGUMENT


def test_only_creating_takes_memory(posing: Entry) -> None:
    before = posing.library.allocations()
    assert before > 0, "what creating took was counted"
    domain = posing.model.problem.domain
    out = np.zeros(3 * len(posing.model.problem.mesh.vertices))
    for share in np.linspace(-1, 1, 7):
        offsets = np.ascontiguousarray(posing.model.problem.offsets(share * domain.half_widths))
        posing.call("set_offsets", address(offsets))
        for dimension in (20, 7, 20):
            assert posing.call("set_dimension", dimension) == 0
            for method in (0, 1):
                posing.solve(method)
        posing.call("get_vertices", address(out))
    assert posing.library.allocations() == before


def test_the_dimension_changes_live(posing: Entry) -> None:
    w = 0.5 * posing.model.problem.domain.half_widths
    posing.call("set_offsets", address(np.ascontiguousarray(posing.model.problem.offsets(w))))
    assert posing.call("dimension") == 20
    assert posing.call("set_dimension", 6) == 0 and posing.call("dimension") == 6
    small = posing.model.leading(6).session(tolerance=1e-10)
    assert posing.solve().value == pytest.approx(small.pose(w).value, rel=1e-8)
    assert posing.call("set_dimension", 0) == posing.call("set_dimension", 21) == BAD_ARGUMENT
    assert posing.call("dimension") == 6


def test_wrong_arguments_are_refused_and_change_nothing(posing: Entry) -> None:
    w = 0.5 * posing.model.problem.domain.half_widths
    offsets = np.ascontiguousarray(posing.model.problem.offsets(w))
    posing.call("set_offsets", address(offsets))
    value = posing.solve().value
    q = posing.read("get_q", 20)
    for bad in (np.nan, np.inf):
        wrong = offsets.copy()
        wrong[1, 2, 3] = bad
        assert posing.call("set_offsets", address(wrong)) == NOT_FINITE
        assert posing.call("set_q", address(np.full(20, bad))) == NOT_FINITE
    assert posing.call("set_weights", address(np.ones(3))) == WRONG_KIND
    for name in ("set_offsets", "set_q", "get_q", "get_vertices"):
        assert posing.call(name, None) == BAD_ARGUMENT
    for option in ("tolerance", "value_scale", "coordinate_scale"):
        for bad in (0.0, -1.0, np.nan):
            options = Options(0, 1e-7, 1.0, 1.0, 1, 1)
            setattr(options, option, bad)
            report = ctypes.byref(Report())
            assert posing.call("solve", ctypes.byref(options), report) == BAD_ARGUMENT
    assert np.array_equal(posing.read("get_q", 20), q)
    assert posing.solve().value == pytest.approx(value, rel=1e-12)


def test_work_is_bounded_and_huge_motions_are_told(posing: Entry) -> None:
    problem = posing.model.problem
    posing.call(
        "set_offsets", address(np.ascontiguousarray(problem.offsets(problem.domain.half_widths)))
    )
    report = posing.solve(max_evaluations=2)
    assert report.status == 4 and report.evaluations <= 2
    q = posing.read("get_q", 20)
    posing.call("set_offsets", address(np.full((3, 3, 4), 1e300)))
    assert posing.solve().status == 3
    assert np.array_equal(posing.read("get_q", 20), q)


def test_a_damaged_model_is_refused(library: ctypes.CDLL) -> None:
    error, basis = ctypes.c_int(0), Basis(0, None, None)
    arrays = [np.zeros(5), np.zeros((1, 1)), np.zeros((1, 1, 12)), np.zeros((1, 4, 4))]
    create = library.snapspace_create_posing
    pointers = [address(array) for array in arrays]
    assert create(1, 1, *pointers, ctypes.byref(basis), ctypes.byref(error)) is None
    assert error.value == NOT_DEFINITE
    assert create(0, 1, *pointers, ctypes.byref(basis), ctypes.byref(error)) is None
    assert error.value == BAD_ARGUMENT
    library.snapspace_destroy(None)


def test_a_damaged_cubature_is_refused(library: ctypes.CDLL) -> None:
    error, basis = ctypes.c_int(0), Basis(0, None, None)
    rows, weights = np.zeros((1, 9, 1), np.float32), np.ones(1)
    handles = [address(np.zeros(size)) for size in (1, 12, 16)]
    create = library.snapspace_create_posing_cubature
    for tets, mu, code in ((1, 1.0, NOT_DEFINITE), (0, 1.0, BAD_ARGUMENT), (1, np.nan, -1)):
        given = ctypes.byref(Cubature(tets, address(rows), address(weights), 1.0, mu))
        assert create(1, 1, given, *handles, ctypes.byref(basis), ctypes.byref(error)) is None
        assert error.value == code


def test_the_header_is_c(tmp_path: Path) -> None:
    c = shutil.which("cc") or shutil.which("gcc")
    if c is None:
        pytest.skip("needs a C compiler (cc or gcc)")
    header = (CORE / "online" / "snapspace_online.h").read_text().replace("#pragma once", "")
    options = [
        "-std=c99",
        "-Wall",
        "-Wextra",
        "-Werror",
        "-pedantic",
        "-fsyntax-only",
        "-x",
        "c",
        "-",
    ]
    run([c, *options], header)
