"""`snapspace pose`: the shapes are those of a session, in every format."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from snapspace import PosingModel, load, read_surface, read_tets
from snapspace.pictures import render
from snapspace.problem import rotation_matrix

from .conftest import Run


@pytest.fixture
def small_pictures(monkeypatch: pytest.MonkeyPatch) -> None:
    def small(*arguments: Any, **options: Any) -> Any:
        return render(*arguments, size=(120, 90), **options)

    monkeypatch.setattr("snapspace.cli.pose.render", small)


def shades(path: Path) -> int:
    """The number of byte values in a small picture; one colour has at most three."""
    with Image.open(path) as image:
        assert image.size == (120, 90)
        return len(set(image.convert("RGB").tobytes()))


def test_a_pose_is_that_of_the_session(run: Run, model: Path, tmp_path: Path) -> None:
    motion = ("--handle", "right", "--euler", "-10,5,20", "--translate", "-0.2,0,0.3")
    figures = run("pose", model, *motion, "-o", tmp_path / "out.obj", "--json").json
    session = load(model).session()
    report = session.pose(np.concatenate([[-0.2, 0, 0.3], np.deg2rad([-10, 5, 20])]))
    vertices, faces = read_surface(tmp_path / "out.obj")
    mesh = load(model).problem.mesh
    np.testing.assert_array_equal(vertices, session.vertices[mesh.surface_vertices])
    np.testing.assert_array_equal(mesh.surface_vertices[faces], mesh.surface)
    assert figures["status"] == "converged"
    assert figures["iterations"] == report.iterations
    assert figures["value"] == report.value
    assert 0 < figures["solve_ms"] <= figures["frame_ms"]
    assert figures["inverted_tets"] == load(model).problem.energy.inverted_tets(session.vertices)


@pytest.mark.usefixtures("small_pictures")
def test_the_users_surface_is_posed_and_drawn(
    run: Run, own_surface_model: PosingModel, tmp_path: Path
) -> None:
    path = own_surface_model.save(tmp_path / "own.snapspace")
    motion = ("--handle", "head", "--translate", "0,0,0.3")
    run("pose", path, *motion, "-o", tmp_path / "out.obj", "--png", tmp_path / "out.png")
    session, surface = own_surface_model.session(), own_surface_model.surface
    session.pose(np.array([0, 0, 0.3, *[0] * 9]))
    vertices, faces = read_surface(tmp_path / "out.obj")
    assert np.array_equal(faces, surface.faces)
    expected = surface.vertices(session.vertices)
    assert np.abs(vertices - expected).max() < 1e-9 * own_surface_model.problem.mesh.diagonal
    assert shades(tmp_path / "out.png") > 100


@pytest.mark.parametrize(
    "words", [(), ("--handle", "right"), ("--handle", "right", "--euler", "0 0 0")]
)
def test_without_a_motion_the_shape_is_at_rest(
    run: Run, model: Path, tmp_path: Path, words: tuple[str, ...]
) -> None:
    figures = run("pose", model, *words, "-o", tmp_path / "out.ply", "--json").json
    mesh = load(model).problem.mesh
    vertices, _ = read_surface(tmp_path / "out.ply")
    np.testing.assert_allclose(vertices, mesh.vertices[mesh.surface_vertices], atol=1e-12)
    assert figures["value"] == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize("name", ["out.msh", "out.vtu", "out.vtk", "out.mesh", "OUT.VTU"])
def test_tets_are_written_by_extension(run: Run, model: Path, tmp_path: Path, name: str) -> None:
    motion = ("--handle", "right", "--translate", "0,0.2,0")
    assert run("pose", model, *motion, "-o", tmp_path / name).code == 0
    session = load(model).session()
    session.pose([0, 0.2, 0, 0, 0, 0])
    mesh = read_tets(tmp_path / name)
    np.testing.assert_array_equal(mesh.vertices, session.vertices)
    np.testing.assert_array_equal(mesh.tets, session.model.problem.mesh.tets)


@pytest.mark.parametrize("name", ["out.obj", "out.ply", "out.off", "out.stl"])
def test_surfaces_are_written_by_extension(
    run: Run, model: Path, tmp_path: Path, name: str
) -> None:
    assert run("pose", model, "-o", tmp_path / name).code == 0
    assert len(read_surface(tmp_path / name)[1]) == len(load(model).problem.mesh.surface)


def test_negative_numbers_may_stand_alone_or_behind_an_equals_sign(
    run: Run, model: Path, tmp_path: Path
) -> None:
    for name, euler in (("a.obj", ["--euler", "-10,0,0"]), ("b.obj", ["--euler=-10,0,0"])):
        assert run("pose", model, "--handle", "right", *euler, "-o", tmp_path / name).code == 0
    assert (tmp_path / "a.obj").read_bytes() == (tmp_path / "b.obj").read_bytes()


def test_the_order_of_translation_and_rotation_does_not_matter(
    run: Run, model: Path, tmp_path: Path
) -> None:
    euler, move = ("--euler", "0,0,20"), ("--translate", "0,0,0.3")
    for name, motion in (("a.obj", euler + move), ("b.obj", move + euler)):
        run("pose", model, "--handle", "right", *motion, "-o", tmp_path / name)
    assert (tmp_path / "a.obj").read_bytes() == (tmp_path / "b.obj").read_bytes()


def test_handles_that_move_together_move_rigidly(run: Run, model: Path, tmp_path: Path) -> None:
    """The same rigid motion of all handles does not deform: v -> R v + t for every vertex."""
    problem = load(model).problem
    turn, shift = rotation_matrix(np.deg2rad([20, -35, 100])), np.array([3.0, -1.0, 2.0])
    words: list[object] = []
    for name, centre in zip(problem.handles.names, problem.centroids, strict=True):
        offset = turn @ centre + shift - centre
        words += ["--handle", name, "--euler", "20,-35,100"]
        words += ["--translate", ",".join(repr(float(x)) for x in offset)]
    result = run("pose", model, *words, "-o", tmp_path / "out.vtu", "--json")
    assert abs(result.json["value"]) < 1e-9
    assert "notice" not in result.err
    moved = read_tets(tmp_path / "out.vtu").vertices
    np.testing.assert_allclose(moved, problem.mesh.vertices @ turn.T + shift, atol=1e-6)


def test_moving_the_fixed_handle_is_as_in_a_session(run: Run, model: Path, tmp_path: Path) -> None:
    words = ("--handle", "left", "--euler", "0,0,15", "--translate", "0.1,0,0")
    run("pose", model, *words, "--handle", "right", "--euler", "10,0,0", "-o", tmp_path / "out.vtu")
    session = load(model).session()
    session.move("right", euler=np.deg2rad([10, 0, 0]))
    session.move("left", euler=np.deg2rad([0, 0, 15]), translation=(0.1, 0, 0))
    moved = read_tets(tmp_path / "out.vtu").vertices
    np.testing.assert_allclose(moved, session.vertices, atol=1e-4)


def test_leading_modes(run: Run, model: Path, tmp_path: Path) -> None:
    motion = ("--handle", "right", "--euler", "0,0,20")
    figures = run(
        "pose", model, *motion, "--dimension", 4, "-o", tmp_path / "out.vtu", "--json"
    ).json
    assert figures["dimension"] == 4
    session = load(model).leading(4).session()
    session.pose([0, 0, 0, 0, 0, np.deg2rad(20)])
    np.testing.assert_array_equal(read_tets(tmp_path / "out.vtu").vertices, session.vertices)


@pytest.mark.parametrize("words", [(), ("--path", 4, "--format", "obj")])
def test_a_motion_without_a_shape_is_refused_and_no_file_written(
    run: Run, model: Path, tmp_path: Path, words: tuple[object, ...]
) -> None:
    motion = ("--handle", "right", "--translate", "0,0,1e300")
    out = tmp_path / ("frames" if words else "out.obj")
    result = run("pose", model, *motion, *words, "-o", out)
    assert "the motion is so large that the energy is not finite" in result.error
    assert not list(tmp_path.rglob("*.obj"))


def test_a_motion_beyond_the_samples_gives_a_notice(run: Run, model: Path) -> None:
    inside = run("pose", model, "--handle", "right", "--euler", "0,0,30")
    beyond = run("pose", model, "--handle", "right", "--euler", "0,0,31")
    assert (inside.code, beyond.code) == (0, 0)
    assert "notice" not in inside.err
    assert "notice: 'right' moves farther, relative to 'left', than the samples" in beyond.err


@pytest.mark.usefixtures("small_pictures")
def test_a_picture(run: Run, model: Path, tmp_path: Path) -> None:
    motion = ("--handle", "right", "--euler", "0,0,30")
    assert run("pose", model, *motion, "--png", tmp_path / "out.png").code == 0
    assert shades(tmp_path / "out.png") > 100
