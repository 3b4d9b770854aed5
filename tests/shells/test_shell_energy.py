"""Closed forms and invariances of shells: membranes, folds, cylinders and spheres."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.optimize import minimize_scalar
from scipy.spatial.transform import Rotation

from snapspace import (
    ARAP,
    Corotational,
    ElasticEnergy,
    Material,
    ShellMesh,
    StableNeoHookean,
    StVK,
    TetMesh,
)
from snapspace.energy.shell_material import element_material

from ..shapes import irregular_bar
from .sheets import bumpy, equilateral, hinge, hinge_vertices, irregular, rolled, sheet, sphere

FloatArray = NDArray[np.float64]

LAM, MU = 1.7, 0.6
PLANE = 2 * LAM * MU / (LAM + 2 * MU)
MATERIALS: list[Material] = [StVK(lam=LAM, mu=MU), StableNeoHookean(lam=LAM, mu=MU)]
each = pytest.mark.parametrize("material", MATERIALS, ids=lambda m: m.kind)
bendings = pytest.mark.parametrize("bending", ["angle", "tangent"])


def parts(energy: ElasticEnergy, x: FloatArray) -> tuple[float, float]:
    """Energies of all triangles, and of all hinges."""
    u = x.reshape(-1) - energy.mesh.vertices.reshape(-1)
    energies = energy.core.tet_stresses(u)[1]
    count = len(energy.mesh.cells)
    return float(energies[:count].sum()), float(energies[count:].sum())


def membrane(material: Material, F: FloatArray) -> float:
    """The density per volume of a 3 x 2 deformation gradient, by its definition."""
    C = F.T @ F
    if isinstance(material, StVK):
        E = (C - np.eye(2)) / 2
        return float(MU * (E**2).sum() + PLANE / 2 * np.trace(E) ** 2)
    J = np.sqrt(np.linalg.det(C))
    return float(MU / 2 * (np.trace(C) - 2) - MU * (J - 1) + (PLANE + MU) / 2 * (J - 1) ** 2)


@each
@pytest.mark.parametrize(
    "F",
    [np.diag([1.3, 0.8]), np.array([[1.0, 0.6], [0.0, 1.0]]), np.diag([1.0 + 1e-7, 1.0])],
    ids=["stretch", "shear", "tiny"],
)
def test_a_homogeneous_strain_has_the_energy_of_its_density(
    material: Material, F: FloatArray
) -> None:
    mesh = irregular(25, thickness=0.04)
    energy = ElasticEnergy(mesh, material)
    turned = Rotation.from_rotvec([0.3, -0.7, 0.5]).as_matrix()[:, :2] @ F
    x = mesh.vertices[:, :2] @ turned.T
    stretched, bent = parts(energy, x)
    expected = mesh.volume * membrane(material, turned)
    # the definition cancels for tiny strains
    assert stretched == pytest.approx(expected, rel=1e-11, abs=1e-17)
    assert bent < 1e-25


@each
def test_a_strip_under_tension_has_the_moduli_of_the_solid(
    material: Material,
) -> None:
    young, poisson = 2.0, 0.4
    made_of = type(material).from_young(youngs_modulus=young, poisson_ratio=poisson)
    mesh = sheet(thickness=0.02)
    energy = ElasticEnergy(mesh, made_of)
    strain = 1e-4

    def pulled(narrowing: float) -> float:
        return energy.value(mesh.vertices * [1 + strain, 1 - narrowing * strain, 1])

    best = minimize_scalar(pulled, bracket=(0.0, 1.0), tol=1e-8)
    assert best.x == pytest.approx(poisson, abs=2e-3)
    assert best.fun == pytest.approx(young / 2 * strain**2 * mesh.volume, rel=1e-3)


def measure(bending: str, angle: float) -> tuple[float, float]:
    """The measure of a hinge's angle, and its slope, by definition."""
    tangent = float(np.tan(angle / 2))
    if bending == "tangent":
        return 2 * tangent, 1 + tangent**2
    return angle + 0.01 * (2 * tangent - angle), 1 + 0.01 * tangent**2


@bendings
@pytest.mark.parametrize("rest", [0.7, -2.8])
def test_a_hinge_has_the_energy_of_its_angle(bending: str, rest: float) -> None:
    mesh = hinge(rest, thickness=0.2)
    energy = ElasticEnergy(mesh, StVK(lam=LAM, mu=MU), bending=bending)  # type: ignore[arg-type]
    stiffness = (2 * MU + PLANE) * 0.2**3 / 12 * mesh.measures[-1]
    at_rest, slope = measure(bending, rest)
    for angle in (-3.1, -1.0, 0.0, rest, 2.0, 3.1):
        strain = (measure(bending, angle)[0] - at_rest) / slope
        stretched, bent = parts(energy, hinge_vertices(angle))
        assert bent == pytest.approx(stiffness / 2 * strain**2, rel=1e-9, abs=1e-25)
        assert stretched < 1e-25


@bendings
def test_small_strains_are_those_of_a_plate_at_every_rest_angle(bending: str) -> None:
    for rest in (0.0, 1.6, -2.9):
        mesh = hinge(rest, thickness=0.2)
        energy = ElasticEnergy(mesh, StVK(lam=LAM, mu=MU), bending=bending)  # type: ignore[arg-type]
        stiffness = (2 * MU + PLANE) * 0.2**3 / 12 * mesh.measures[-1]
        bent = parts(energy, hinge_vertices(rest + 1e-5))[1]
        assert bent == pytest.approx(stiffness / 2 * 1e-10, rel=1e-3)


@bendings
def test_a_fold_is_a_barrier(bending: str) -> None:
    energy = ElasticEnergy(hinge(0.0), StVK(), bending=bending)  # type: ignore[arg-type]
    values = [energy.value(hinge_vertices(np.pi - small)) for small in (1e-4, 1e-5, 1e-6)]
    np.testing.assert_allclose(np.diff(np.log(values)), 2 * np.log(10), rtol=2e-2)
    folded = energy.value_and_gradient(hinge_vertices(np.pi))
    assert np.isfinite(folded[0]) and np.isfinite(folded[1]).all()


def collapsed() -> dict[str, FloatArray]:
    """Vertices of a hinge whose triangles are degenerate, folded or on top of each other."""
    whole = hinge_vertices(0.0)
    point, line, one, double = whole * 0, whole * [1, 0, 0], whole.copy(), whole.copy()
    one[2] = whole[0]
    double[3] = whole[2]
    return {"point": point, "line": line, "one triangle": one, "fold": double}


@each
@bendings
@pytest.mark.parametrize("shape", collapsed())
def test_degenerate_hinges_and_triangles_are_finite(
    material: Material, bending: str, shape: str
) -> None:
    energy = ElasticEnergy(hinge(0.3), material, bending=bending)  # type: ignore[arg-type]
    x = collapsed()[shape]
    value, gradient = energy.value_and_gradient(x)
    assert np.isfinite(value) and value > 0 and np.isfinite(gradient).all()
    assert np.isfinite(energy.projected_hessian(x).toarray()).all()


def test_bending_vanishes_with_the_area_of_a_triangle() -> None:
    """The angle's gradient alone grows as one over the height: solves would get stuck."""
    mesh = hinge(0.3)
    energy = ElasticEnergy(mesh, StVK())
    forces, values = [], []
    for height in (1.0, 1e-2, 1e-4):
        x = hinge_vertices(1.2)
        x[2] = height * x[2] + (1 - height) * np.array([0.4, 0, 0])
        stresses, energies = energy.core.tet_stresses((x - mesh.vertices).reshape(-1))
        forces.append(np.linalg.norm(stresses[-1]))
        values.append(energies[-1])
    assert forces[1] < forces[0] and forces[2] < forces[0]
    assert values[1] / values[0] == pytest.approx(4e-4, rel=1e-3)


@each
@bendings
def test_rigid_motions_change_nothing(material: Material, bending: str) -> None:
    mesh = sphere(1)
    energy = ElasticEnergy(mesh, material, bending=bending)  # type: ignore[arg-type]
    turn = Rotation.from_rotvec([1.0, 2.0, -0.4]).as_matrix()
    assert energy.value(mesh.vertices @ turn.T + [1.0, -2.0, 3.0]) < 1e-26
    x = bumpy(mesh, 0.1).reshape(-1, 3)
    value, gradient = energy.value_and_gradient(x)
    moved, turned = energy.value_and_gradient(x @ turn.T + [1.0, -2.0, 3.0])
    assert moved == pytest.approx(value, rel=1e-12)
    np.testing.assert_allclose(turned.reshape(-1, 3), gradient.reshape(-1, 3) @ turn.T, atol=1e-12)
    # and neither does a reflection: a surface has no inside
    assert energy.value(x * [1, 1, -1]) != pytest.approx(value, rel=1e-3)
    flipped = ShellMesh(mesh.vertices, mesh.triangles[:, ::-1], thickness=mesh.thickness)
    other = ElasticEnergy(flipped, material, bending=bending)  # type: ignore[arg-type]
    assert other.value(x) == pytest.approx(value, rel=1e-10)


def cylinder_ratio(mesh: ShellMesh, direction: float, curvature: float = 0.2) -> float:
    """Bending energy on a cylinder, relative to D/2 curvature^2 times the area of inner edges."""
    energy = ElasticEnergy(mesh, StVK(lam=LAM, mu=MU))
    bent = parts(energy, rolled(mesh.vertices, curvature, direction))[1]
    rigidity = (2 * MU + PLANE) * mesh.thickness**3 / 12
    inner = mesh.areas[mesh.hinge_triangles].sum() / 3
    return float(bent / (rigidity / 2 * curvature**2 * inner))


def test_a_plate_bent_to_a_cylinder_has_the_energy_of_the_continuum() -> None:
    """Equilateral triangles, in every direction; the error falls with the width of the margin."""
    for direction in (0.0, 0.3, 1.2):
        errors = [
            abs(cylinder_ratio(equilateral(n, n, thickness=0.01), direction) - 1)
            for n in (8, 16, 32)
        ]
        assert errors[-1] < 0.02
        assert np.log2(errors[-2] / errors[-1]) == pytest.approx(1.0, abs=0.15)


def test_an_irregular_plate_bends_like_the_continuum_in_all_directions() -> None:
    """The usual weights of hinges would make it stiffer by half."""
    mesh = irregular(900, thickness=0.01)
    ratios = [cylinder_ratio(mesh, direction) for direction in np.linspace(0, np.pi, 7)]
    np.testing.assert_allclose(ratios, 1.0, atol=0.05)


@pytest.mark.parametrize("alternating", [False, True])
def test_a_right_angled_grid_bends_like_the_continuum_on_average(alternating: bool) -> None:
    mesh = sheet(40, 40, size=(1, 1), thickness=0.01, alternating=alternating)
    directions = np.arange(8) * np.pi / 8
    ratios = [cylinder_ratio(mesh, direction, 0.02) for direction in directions]
    assert np.mean(ratios) == pytest.approx(1.0, abs=0.03)


def test_the_bending_of_a_sphere_is_that_of_a_plate_of_poisson_ratio_minus_a_third() -> None:
    """D/2 (H^2 - 2 (1 - nu) K) with H = 2 and K = 1: 2/3 D for nu = -1/3, at second order."""
    errors = []
    for level in (2, 3, 4):
        ball = sphere(level)
        angles = hinge_angles(ball)
        hinges = ball.measures[len(ball.triangles) :]
        errors.append(abs(hinges @ angles**2 / 2 / ball.areas.sum() / (2 / 3) - 1))
    assert errors[-1] < 1e-3
    assert np.log2(errors[-2] / errors[-1]) > 1.8


def hinge_angles(mesh: ShellMesh) -> FloatArray:
    corners = mesh.vertices[mesh.triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    one, other = normals[mesh.hinge_triangles].transpose(1, 0, 2)
    cosines: FloatArray = np.einsum("hi,hi->h", one, other)
    return np.arccos(np.minimum(cosines, 1.0))


@each
def test_a_developable_strip_only_bends(material: Material) -> None:
    """If it is rolled by an isometry, only the membrane's share falls at order four."""
    shares = []
    for n in (8, 16, 32):
        mesh = sheet(n, n, thickness=0.05)
        stretched, bent = parts(ElasticEnergy(mesh, material), rolled(mesh.vertices, 1.0))
        shares.append(stretched / bent)
    assert np.log2(shares[-2] / shares[-1]) == pytest.approx(4.0, abs=0.2)


def test_energies_scale_with_thickness_as_a_membrane_and_a_plate() -> None:
    values = []
    for thickness in (0.01, 0.02):
        mesh = sheet(thickness=thickness)
        values.append(parts(ElasticEnergy(mesh, StVK()), bumpy(mesh, 0.01)))
    np.testing.assert_allclose(np.divide(values[1], values[0]), [2.0, 8.0])


def test_per_triangle_moduli_are_those_of_their_triangles() -> None:
    mesh = irregular(20)
    count = len(mesh.triangles)
    even = ElasticEnergy(mesh, StableNeoHookean(lam=LAM, mu=MU))
    same = ElasticEnergy(mesh, StableNeoHookean(lam=np.full(count, LAM), mu=np.full(count, MU)))
    x = bumpy(mesh, 0.001)
    assert same.value(x) == even.value(x)


def test_numbers_that_triangles_do_not_use_are_zero() -> None:
    mesh = irregular(20)
    rows = element_material(mesh, StVK(), who="test").moduli
    assert not rows[: len(mesh.triangles), 9:].any()


def test_what_a_shell_cannot_be_is_refused() -> None:
    with pytest.raises(ValueError, match=r"cannot be made of fixed corotational, .*StVK or ARAP"):
        ElasticEnergy(sheet(), Corotational())
    with pytest.raises(ValueError, match="ARAP has no hinges, so bending cannot be 'tangent'"):
        ElasticEnergy(sheet(), ARAP(), bending="tangent")
    with pytest.raises(ValueError, match="unknown bending 'cosine'; known are angle, tangent"):
        ElasticEnergy(sheet(), StVK(), bending="cosine")  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="moduli for 3 tets, but the mesh has 48"):
        ElasticEnergy(sheet(), StVK(lam=np.ones(3), mu=np.ones(3)))


def test_a_shell_has_no_inverted_tets() -> None:
    mesh: TetMesh | ShellMesh
    for mesh, count in ((sheet(), 0), (irregular_bar(), len(irregular_bar().tets))):
        energy = ElasticEnergy(mesh, StVK())
        assert energy.inverted_tets(mesh.vertices * [1, 1, -1]) == count
