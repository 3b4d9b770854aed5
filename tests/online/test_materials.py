"""Every registered material through the C interface, with different moduli in every tet."""

from __future__ import annotations

import ctypes
import sys
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import InterpolationModel, PosingModel
from snapspace.certificate import ElementProbe, residual_probe
from snapspace.material import MATERIALS

from ..page.material_models import material_model, some_estimator
from .entry import Entry, material, pin_arrays
from .library import Material, Probe, address

pytestmark = pytest.mark.skipif(
    not sys.platform.startswith("linux"), reason="compiles a shared library as on Linux"
)
BAD_ARGUMENT, NOT_FINITE, WRONG_KIND, UNKNOWN_MATERIAL = -1, -2, -4, -5


def c_probe(probe: ElementProbe, model: PosingModel | InterpolationModel) -> tuple[Probe, Any]:
    """The C struct, and the arrays that it points to."""
    modes = model.subspace.basis.reshape(-1, 3, model.dimension)[probe.corners]
    arrays = {
        "tau": np.ascontiguousarray(model.subspace.tau.reshape(-1, 3)[probe.corners]),
        "modes": np.ascontiguousarray(np.moveaxis(modes, 2, 0)),
        "rest_shapes": probe.rests,
        "tet_corners": probe.tets,
        "sampled": probe.places,
        "weights": probe.weights,
        **pin_arrays(probe.pins),
    }
    arrays = {name: array.copy() for name, array in arrays.items()}
    sizes = {
        "corners": len(probe.corners),
        "tets": len(probe.tets),
        "rests": len(probe.rests),
        "samples": len(probe.places),
        "pins": len(probe.pins.pinned),
    }
    pointers: dict[str, Any] = {name: address(array) for name, array in arrays.items()}
    return Probe(**sizes, **pointers, material=material(probe.material)), arrays


@pytest.fixture(params=sorted(MATERIALS))
def entry(library: ctypes.CDLL, cubature_model: PosingModel, request: Any) -> Any:
    made = Entry(library, material_model(cubature_model, request.param))
    yield made
    library.snapspace_destroy(made.session)


def test_value_and_residual_are_those_of_python(entry: Entry) -> None:
    model = entry.model
    assert isinstance(model, PosingModel) and model.error_estimator is not None
    probe = residual_probe(model.problem, model.subspace, model.error_estimator.sample)
    assert len(probe.pins.pinned) > 0
    given, kept = c_probe(probe, model)
    assert entry.call("residual", ctypes.byref(ctypes.c_double())) == WRONG_KIND, "not set yet"
    assert entry.call("set_probe", ctypes.byref(given)) == 0
    for array in kept.values():
        array.fill(0)  # the session has copies
    allocated = entry.library.allocations()
    rng = np.random.default_rng(1)
    for size in (0.0, 0.01, 0.1):
        q = size * model.coordinate_scale * rng.normal(size=model.dimension)
        w = size * model.problem.domain.half_widths
        offsets = np.ascontiguousarray(model.problem.offsets(w))
        assert entry.call("set_offsets", address(offsets)) == entry.call("set_q", address(q)) == 0
        value = ctypes.c_double()
        assert entry.call("value", address(q), ctypes.byref(value)) == 0
        assert value.value == pytest.approx(model.value(q, offsets), rel=1e-9, abs=1e-12)
        assert entry.residual() == pytest.approx(probe.norm(q, offsets), rel=1e-12, abs=1e-12)
    assert entry.call("set_dimension", 5) == 0
    assert entry.residual() == pytest.approx(probe.norm(q[:5], offsets), rel=1e-12)
    assert entry.library.allocations() == allocated, "only setting the probe allocates memory"


def test_a_blend_sums_the_residuals_of_its_poses(
    library: ctypes.CDLL, blending_model: InterpolationModel
) -> None:
    entry, model = Entry(library, blending_model), blending_model
    sample = some_estimator(model).sample
    probe = residual_probe(model.problem, model.subspace, sample)
    given, kept = c_probe(probe, model)
    assert entry.call("set_probe", ctypes.byref(given)) == 0 and kept
    q = 0.05 * model.coordinate_scale * np.linspace(1, -1, model.dimension)
    assert entry.call("set_q", address(q)) == 0
    equal = np.full(3, 1 / 3)
    assert entry.residual() == pytest.approx(probe.norm(q, equal), rel=1e-12), "weights at first"
    weights = np.array([1.2, -0.1, -0.1])
    assert entry.call("set_weights", address(weights)) == 0
    assert entry.residual() == pytest.approx(probe.norm(q, weights), rel=1e-12)
    given.rests = 1
    assert entry.call("set_probe", ctypes.byref(given)) == BAD_ARGUMENT
    library.snapspace_destroy(entry.session)


def test_a_faulty_probe_is_refused_and_the_one_before_stays(entry: Entry) -> None:
    model = entry.model
    assert isinstance(model, PosingModel) and model.error_estimator is not None
    probe = residual_probe(model.problem, model.subspace, model.error_estimator.sample)
    given, arrays = c_probe(probe, model)
    assert entry.call("set_probe", ctypes.byref(given)) == 0
    before = entry.residual()

    def refused(**fields: Any) -> int:
        wrong, kept = c_probe(probe, model)
        assert kept
        for name, value in fields.items():
            setattr(wrong, name, value)
        return entry.call("set_probe", ctypes.byref(wrong))

    assert entry.call("set_probe", None) == BAD_ARGUMENT
    for size in ("corners", "tets", "rests", "samples"):
        assert refused(**{size: 0}) == BAD_ARGUMENT
    for pointer in ("tau", "modes", "tet_corners", "sampled", "pinned", "arms"):
        assert refused(**{pointer: None}) == BAD_ARGUMENT
    assert refused(corners=len(probe.corners) - 1) == BAD_ARGUMENT, "indices out of range"
    for name in ("tet_corners", "sampled", "pinned", "pin_handles"):
        for bad in (-1, 10**6):
            indices: NDArray[np.int32] = arrays[name].copy()
            indices.reshape(-1)[0] = bad
            assert refused(**{name: address(indices)}) == BAD_ARGUMENT
    moduli = np.array([[1.0, np.nan]])
    kind = probe.material.kind.encode()
    assert refused(material=Material(b"mud", 1, address(np.ones((1, 2))))) == UNKNOWN_MATERIAL
    assert refused(material=Material(kind, 2, address(np.ones((2, 2))))) == BAD_ARGUMENT
    star = Material(b"shell-arap", 1, address(np.ones((1, 12))))
    assert refused(material=star) == BAD_ARGUMENT, "shells have a row per element"
    if probe.material.moduli.shape[1] == 2:
        assert refused(material=Material(kind, 1, address(moduli))) == NOT_FINITE
    assert entry.residual() == before


def test_names_of_moduli_and_the_unit_of_energy(
    library: ctypes.CDLL, cubature_model: PosingModel
) -> None:
    for kind, known in MATERIALS.items():
        names = [library.snapspace_modulus_name(kind.encode(), i) for i in range(-1, 6)]
        assert tuple(n.decode() for n in names if n) == known.names()
        assert names[0] is None
        assert library.snapspace_moduli(kind.encode()) == len(known.names())
        model = material_model(cubature_model, kind)
        volumes, scale = model.problem.mesh.volumes, ctypes.c_double()
        given = ctypes.byref(material(model.problem.material))
        arguments = (len(volumes), address(volumes), ctypes.byref(scale))
        assert library.snapspace_value_scale(given, *arguments) == 0
        assert scale.value == pytest.approx(model.value_scale, rel=1e-12)
        assert library.snapspace_value_scale(given, 3, *arguments[1:]) == BAD_ARGUMENT
    assert library.snapspace_moduli(b"mud") == UNKNOWN_MATERIAL
    assert library.snapspace_modulus_name(b"mud", 0) is None
