"""Residuals of as-rigid-as-possible surfaces through the C interface."""

from __future__ import annotations

import ctypes
import sys
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import ARAP, InterpolationModel, PosingModel, ReducedModel
from snapspace import certificate as ss

from ..shells.strips import WIDE, blended_strips, shell_model
from .entry import Entry, material, pin_arrays
from .library import Material, Probe, StarProbe, address

pytestmark = pytest.mark.skipif(
    not sys.platform.startswith("linux"), reason="compiles a shared library as on Linux"
)
BAD_ARGUMENT, NOT_FINITE, WRONG_KIND, UNKNOWN_MATERIAL = -1, -2, -4, -5


@pytest.fixture(scope="module")
def posed() -> PosingModel:
    return shell_model(ARAP(), varied=True, radius=WIDE)


@pytest.fixture(scope="module")
def blended() -> InterpolationModel:
    return blended_strips(ARAP(radius=WIDE))


def probe_of(model: PosingModel | InterpolationModel) -> ss.StarProbe:
    """A probe at all vertices."""
    n = len(model.problem.mesh.vertices)
    sample = ss.ResidualSample(np.arange(n, dtype=np.int32), np.linspace(1, 2, n))
    made = ss.residual_probe(model.problem, model.subspace, sample)
    assert isinstance(made, ss.StarProbe)
    return made


def given(probe: ss.StarProbe) -> tuple[StarProbe, dict[str, NDArray[Any]]]:
    """The C struct, and the arrays that it points to."""
    arrays = {
        "origins": probe.origins,
        "modes": probe.modes,
        "part_stars": probe.part_stars,
        "part_samples": probe.part_places,
        "part_vectors": probe.part_vectors,
        "weights": probe.weights,
        **pin_arrays(probe.pins),
    }
    arrays = {name: np.ascontiguousarray(array).copy() for name, array in arrays.items()}
    sizes = {
        "stars": len(probe.stars),
        "rests": len(probe.origins),
        "samples": len(probe.weights),
        "parts": len(probe.part_stars),
        "pins": len(probe.pins.pinned),
    }
    pointers: dict[str, Any] = {name: address(array) for name, array in arrays.items()}
    return StarProbe(**sizes, **pointers, material=material(probe.material)), arrays


def set_probe(entry: Entry, probe: StarProbe | None) -> int:
    return entry.call("set_star_probe", None if probe is None else ctypes.byref(probe))


def some_shape(model: ReducedModel) -> NDArray[np.float64]:
    return np.asarray(0.05 * model.coordinate_scale * np.linspace(1, -1, model.dimension))


def test_residuals_of_handles_are_those_of_python(library: ctypes.CDLL, posed: PosingModel) -> None:
    entry, probe, q = Entry(library, posed), probe_of(posed), some_shape(posed)
    made, kept = given(probe)
    assert made.pins > 0
    assert entry.call("residual", ctypes.byref(ctypes.c_double())) == WRONG_KIND, "not set yet"
    assert set_probe(entry, made) == 0
    for array in kept.values():
        array.fill(0)  # the session has copies
    allocated = library.allocations()
    offsets = np.ascontiguousarray(posed.problem.offsets(0.4 * posed.problem.domain.half_widths))
    assert entry.call("set_offsets", address(offsets)) == entry.call("set_q", address(q)) == 0
    assert entry.residual() == pytest.approx(probe.norm(q, offsets), rel=1e-12)
    assert entry.call("set_dimension", 5) == 0
    assert entry.residual() == pytest.approx(probe.norm(q[:5], offsets), rel=1e-12)
    assert library.allocations() == allocated, "only setting the probe allocates memory"
    library.snapspace_destroy(entry.session)


def test_residuals_of_blends_are_those_of_python(
    library: ctypes.CDLL, blended: InterpolationModel
) -> None:
    entry, probe, q = Entry(library, blended), probe_of(blended), some_shape(blended)
    made, kept = given(probe)
    assert set_probe(entry, made) == 0 and kept
    assert entry.call("set_q", address(q)) == 0
    assert entry.residual() == pytest.approx(probe.norm(q, np.full(3, 1 / 3)), rel=1e-12)
    weights = np.array([1.2, 0.0, -0.2])
    assert entry.call("set_weights", address(weights)) == 0
    assert entry.residual() == pytest.approx(probe.norm(q, weights), rel=1e-12)
    made.rests = 1
    assert set_probe(entry, made) == BAD_ARGUMENT
    library.snapspace_destroy(entry.session)


def test_a_faulty_probe_is_refused_and_the_one_before_stays(
    library: ctypes.CDLL, posed: PosingModel
) -> None:
    entry, probe = Entry(library, posed), probe_of(posed)
    made, arrays = given(probe)
    assert set_probe(entry, made) == 0
    before = entry.residual()

    def refused(**fields: Any) -> int:
        wrong, kept = given(probe)
        assert kept
        for name, value in fields.items():
            setattr(wrong, name, value)
        return set_probe(entry, wrong)

    assert set_probe(entry, None) == BAD_ARGUMENT
    for size in ("stars", "rests", "samples", "parts"):
        assert refused(**{size: 0}) == BAD_ARGUMENT
    for name in arrays:
        assert refused(**{name: None}) == BAD_ARGUMENT
    for name in ("part_stars", "part_samples", "pinned", "pin_handles"):
        for bad in (-1, 10**6):
            indices: NDArray[np.int32] = arrays[name].copy()
            indices.reshape(-1)[0] = bad
            assert refused(**{name: address(indices)}) == BAD_ARGUMENT
    moduli = probe.material.moduli.copy()
    rows = len(moduli)
    assert refused(material=Material(b"mud", rows, address(moduli))) == UNKNOWN_MATERIAL
    assert refused(material=Material(b"shell-arap", 1, address(moduli))) == BAD_ARGUMENT
    of_solids = Material(b"arap", 1, address(np.ones((1, 1))))
    assert refused(material=of_solids) == BAD_ARGUMENT, "tets are no stars"
    moduli[0, 5] = np.nan
    assert refused(material=Material(b"shell-arap", rows, address(moduli))) == NOT_FINITE
    points, corners = address(np.ones((4, 3))), address(np.arange(4, dtype=np.int32))
    modes = address(arrays["origins"])  # refused before they are read
    tets = Probe(4, 1, 1, 1, 0, points, modes, points, corners)
    tets.material = Material(b"shell-arap", 1, address(np.ones((1, 12))))
    tets.sampled, tets.weights = corners, points
    assert entry.call("set_probe", ctypes.byref(tets)) == BAD_ARGUMENT, "stars are no tets"
    assert entry.residual() == before
    library.snapspace_destroy(entry.session)
