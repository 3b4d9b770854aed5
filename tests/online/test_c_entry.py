"""The plain C interface gives the same results as a session."""

from __future__ import annotations

import ctypes
import shutil
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import InterpolationModel, PosingModel

from ..clustered import clustered_model
from .entry import Entry, cubature
from .library import CORE, Basis, Clusters, Cubature, Material, Options, Report, address, run

pytestmark = pytest.mark.skipif(
    not sys.platform.startswith("linux"), reason="compiles a shared library as on Linux"
)
FloatArray = NDArray[np.float64]
BAD_ARGUMENT, NOT_FINITE, NOT_DEFINITE, WRONG_KIND, UNKNOWN_MATERIAL = -1, -2, -3, -4, -5


@pytest.fixture
def posing(library: ctypes.CDLL, posing_model: PosingModel) -> Any:
    entry = Entry(library, posing_model)
    yield entry
    library.snapspace_destroy(entry.session)


@pytest.mark.parametrize(("method", "minimizer"), [(0, "newton"), (1, "bfgs")])
def test_a_drag_agrees_with_the_session(posing: Entry, method: int, minimizer: str) -> None:
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


@pytest.mark.parametrize("clustered", [False, True], ids=["rows", "local rows"])
def test_a_drag_with_a_cubature_agrees_with_the_session(
    library: ctypes.CDLL, cubature_model: PosingModel, clustered: bool
) -> None:
    model = clustered_model(cubature_model, 15) if clustered else cubature_model
    entry, problem = Entry(library, model), model.problem
    session, d = model.session(tolerance=1e-10), model.dimension
    allocated = library.allocations()
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
            scale = model.coordinate_scale
            assert entry.read("get_q", dimension) == pytest.approx(session.q, abs=1e-5 * scale)
    assert entry.call("set_weights", address(np.ones(3))) == WRONG_KIND
    assert library.allocations() == allocated
    library.snapspace_destroy(entry.session)


def test_blends_agree_with_the_session(
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


def test_the_value_is_computed_at_any_coordinates(posing: Entry) -> None:
    model, q = posing.model, np.linspace(-0.1, 0.1, 20)
    assert isinstance(model, PosingModel)
    w = 0.5 * model.problem.domain.half_widths
    offsets = np.ascontiguousarray(model.problem.offsets(w))
    posing.call("set_offsets", address(offsets))
    value = ctypes.c_double(np.nan)
    assert posing.call("value", address(q), posing.reference(value)) == 0
    assert value.value == pytest.approx(model.value(q, offsets), rel=1e-9)
    assert not posing.read("get_q", 20).any(), "computing a value does not move the shape"
    assert posing.call("value", address(np.full(20, np.nan)), posing.reference(value)) == NOT_FINITE
    assert posing.call("value", None, posing.reference(value)) == BAD_ARGUMENT


def test_only_creating_allocates_memory(posing: Entry) -> None:
    before = posing.library.allocations()
    assert before > 0, "allocations on creation were counted"
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


def test_work_is_bounded_and_huge_motions_are_reported(posing: Entry) -> None:
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
    for tets, kind, rows_of_moduli, mu, code in (
        (1, "stvk", 1, 1.0, NOT_DEFINITE),
        (0, "stvk", 1, 1.0, BAD_ARGUMENT),
        (1, "stvk", 2, 1.0, BAD_ARGUMENT),
        (1, "stvk", 1, -1.0, BAD_ARGUMENT),
        (1, "stvk", 1, np.nan, NOT_FINITE),
        (1, "mud", 1, 1.0, UNKNOWN_MATERIAL),
        (1, "stvk ", 1, 1.0, UNKNOWN_MATERIAL),
    ):
        moduli = np.tile([1.0, mu], (rows_of_moduli, 1))
        made = Material(kind.encode(), rows_of_moduli, address(moduli))
        given = ctypes.byref(Cubature(tets, address(rows), address(weights), made))
        assert create(1, 1, given, *handles, ctypes.byref(basis), ctypes.byref(error)) is None
        assert error.value == code
    for missing in (Material(None, 1, address(weights)), Material(b"arap", 1, None)):
        given = ctypes.byref(Cubature(1, address(rows), address(weights), missing))
        assert create(1, 1, given, *handles, ctypes.byref(basis), ctypes.byref(error)) is None
        assert error.value == BAD_ARGUMENT


def test_damaged_clusters_are_refused(library: ctypes.CDLL, cubature_model: PosingModel) -> None:
    entry = Entry(library, clustered_model(cubature_model, 15))
    given = cubature(entry.model.elastic)
    error, d = ctypes.c_int(0), entry.model.dimension
    handles = [address(getattr(entry.model.handles, name)) for name in ("K", "L", "S")]
    count = len(entry.model.problem.handles)
    create = library.snapspace_create_posing_cubature
    sizes = entry.model.elastic.stored_rows.sizes

    def refused(clusters: Clusters) -> bool:
        given.clusters = clusters
        basis = ctypes.byref(entry.basis)
        made = create(d, count, ctypes.byref(given), *handles, basis, ctypes.byref(error))
        return made is None and error.value == BAD_ARGUMENT

    good = given.clusters
    for change in ([1, 0], [-8, 0], [8, 0], [-int(sizes[0, 0]), 0], [0, -100]):
        bad = sizes + np.array([change] + [[0, 0]] * (len(sizes) - 1), np.int32)
        assert refused(Clusters(len(bad), address(bad), good.modes))
    for clusters in (
        Clusters(len(sizes) - 1, good.sizes, good.modes),
        Clusters(-1, good.sizes, good.modes),
        Clusters(len(sizes), None, good.modes),
        Clusters(len(sizes), good.sizes, None),
    ):
        assert refused(clusters)
    library.snapspace_destroy(entry.session)


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
