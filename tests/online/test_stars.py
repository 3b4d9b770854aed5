"""Blends of as-rigid-as-possible surfaces through the C interface."""

from __future__ import annotations

import ctypes
import sys
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import _core as core

from .library import Basis, Cubature, Material, Options, Report, Stars, address

pytestmark = pytest.mark.skipif(
    not sys.platform.startswith("linux"), reason="compiles a shared library as on Linux"
)
BAD_ARGUMENT, NOT_FINITE, NOT_DEFINITE, UNKNOWN_MATERIAL = -1, -2, -3, -5
POSES, STARS, D = 3, 5, 4
REFERENCE = ctypes.byref
Arrays = dict[str, NDArray[Any]]


@pytest.fixture
def arrays() -> Arrays:
    """Stars of flat frames that poses turn and stretch differently, and forms that are convex."""
    rng = np.random.default_rng(5)
    moduli = np.zeros((POSES * STARS, 12))
    moduli[:, 0] = rng.uniform(0.5, 2, POSES * STARS)
    moduli[:, [3, 6]] = 1  # the frame's first two columns
    factors = 0.1 * rng.normal(size=(POSES, D + 1, D + 1))
    return {
        "rows": rng.normal(size=(POSES, STARS, 9, D)).astype(np.float32),
        "weights": rng.uniform(0.5, 2, STARS),
        "moduli": moduli,
        "origins": 0.2 * rng.normal(size=(POSES, STARS, 9)),
        "forms": factors @ factors.swapaxes(1, 2),
    }


def stars_of(arrays: Arrays, **changes: Any) -> Stars:
    pointers = {n: address(arrays[n]) for n in ("rows", "weights", "origins", "forms")}
    material = Material(b"shell-arap", len(arrays["moduli"]), address(arrays["moduli"]))
    return Stars(**{"poses": POSES, "stars": STARS, "material": material, **pointers, **changes})


def created(library: ctypes.CDLL, stars: Stars | None, dimension: int = D) -> tuple[Any, int]:
    basis, error = Basis(0, None, None), ctypes.c_int(7)
    given = stars if stars is None else REFERENCE(stars)
    create = library.snapspace_create_blending_stars
    return create(dimension, given, REFERENCE(basis), REFERENCE(error)), error.value


def test_blends_are_those_of_the_core(library: ctypes.CDLL, arrays: Arrays) -> None:
    made, error = created(library, stars_of(arrays))
    assert error == 0
    session = ctypes.c_void_p(made)
    blended = core.BlendedStars(
        arrays["rows"].reshape(-1, 9, D),
        arrays["weights"],
        core.Material("shell-arap", arrays["moduli"].copy()),
        arrays["origins"].copy(),
        arrays["forms"].copy(),
    )
    for array in arrays.values():
        array.fill(0)  # the session has copies
    allocated = library.allocations()
    value, report = ctypes.c_double(), Report()
    q = np.linspace(-0.3, 0.2, D)
    for method, weights in ((0, [0.2, 0.7, 0.1]), (1, [0.0, 1.2, -0.2]), (1, [1.0, 0.0, 0.0])):
        w = np.array(weights)
        blended.set_weights(w)
        assert library.snapspace_set_weights(session, address(w)) == 0
        assert library.snapspace_value(session, address(q), REFERENCE(value)) == 0
        assert value.value == pytest.approx(blended.value_and_gradient(q)[0], rel=1e-12)
        options = Options(method, 1e-12, 1.0, 1.0, 300, 500)
        assert library.snapspace_solve(session, REFERENCE(options), REFERENCE(report)) == 0
        found = np.zeros(D)
        assert library.snapspace_get_q(session, address(found)) == 0
        least, gradient = blended.value_and_gradient(found)
        assert report.status == 0 and report.value == pytest.approx(least, rel=1e-12)
        assert np.abs(gradient).max() < 1e-5
    assert library.snapspace_set_dimension(session, 2) == 0
    q[2:] = 0.0
    assert library.snapspace_value(session, address(q), REFERENCE(value)) == 0
    assert value.value == pytest.approx(blended.value_and_gradient(q)[0], rel=1e-12)
    assert library.allocations() == allocated
    library.snapspace_destroy(session)


def test_wrong_stars_are_refused(library: ctypes.CDLL, arrays: Arrays) -> None:
    moduli = arrays["moduli"]

    def material(kind: bytes, numbers: NDArray[np.float64]) -> dict[str, Material]:
        return {"material": Material(kind, len(numbers), address(numbers))}

    negative, unknown = moduli.copy(), moduli.copy()
    negative[1, 0], unknown[1, 5] = -1.0, np.nan
    cases: tuple[tuple[dict[str, Any], int], ...] = (
        ({"poses": 0}, BAD_ARGUMENT),
        ({"stars": 0}, BAD_ARGUMENT),
        ({"rows": None}, BAD_ARGUMENT),
        ({"weights": None}, BAD_ARGUMENT),
        ({"origins": None}, BAD_ARGUMENT),
        ({"forms": None}, BAD_ARGUMENT),
        ({"material": Material(None, 1, address(moduli))}, BAD_ARGUMENT),
        ({"material": Material(b"shell-arap", 1, None)}, BAD_ARGUMENT),
        (material(b"shell-arap", moduli[:STARS]), BAD_ARGUMENT),
        (material(b"shell-arap", moduli[:1]), BAD_ARGUMENT),
        (material(b"shell-arap", negative), BAD_ARGUMENT),
        (material(b"shell-arap", unknown), NOT_FINITE),
        (material(b"arap", np.ones((1, 1))), BAD_ARGUMENT),
        (material(b"mud", np.ones((1, 2))), UNKNOWN_MATERIAL),
    )
    for changes, code in cases:
        assert created(library, stars_of(arrays, **changes)) == (None, code)
    assert created(library, None) == (None, BAD_ARGUMENT)
    assert created(library, stars_of(arrays), dimension=0) == (None, BAD_ARGUMENT)
    arrays["forms"][:, 0, 0] = np.nan
    assert created(library, stars_of(arrays)) == (None, NOT_DEFINITE)


def test_a_cubature_of_tets_does_not_take_stars(library: ctypes.CDLL, arrays: Arrays) -> None:
    material = Material(b"shell-arap", 1, address(arrays["moduli"]))
    cubature = Cubature(1, address(arrays["rows"]), address(arrays["weights"]), material)
    corners, tau, error = np.zeros((1, 12)), np.zeros(12), ctypes.c_int(0)
    made = library.snapspace_create_blending_cubature(
        D,
        1,
        REFERENCE(cubature),
        address(corners),
        address(tau),
        REFERENCE(Basis(0, None, None)),
        REFERENCE(error),
    )
    assert made is None and error.value == BAD_ARGUMENT
