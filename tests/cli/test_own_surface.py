"""`pose` and `blend` write the user's own surface file, with other positions and all else kept."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from snapspace import embed_surface, load, open_surface, read_surface, read_tets

from ..mesh.surface_files import QUADS, write_file
from .conftest import Run
from .files import write_problem

MOVE = ("--handle", "right", "--euler", "0,0,20")
SMALL = ("--samples", 12, "--dimension", 6)


@pytest.fixture
def own_model(run: Run, tmp_path: Path) -> Path:
    """A model of the bar that shows a cube of quads with UVs, in the bar's first quarter."""
    write_file(tmp_path, "obj relative")
    path = tmp_path / "m.snapspace"
    problem = write_problem(tmp_path, surface="cube.obj")
    assert run("build", "--problem", problem, *SMALL, "-o", path).code == 0
    return path


def test_the_model_writes_the_file_that_it_was_made_from(run: Run, own_model: Path) -> None:
    folder = own_model.parent
    out, other = folder / "out.obj", folder / "out.ply"
    file = (folder / "cube.obj").read_bytes()
    (folder / "cube.obj").unlink()  # the model has it
    shape = run("pose", own_model, *MOVE, "-o", out)
    assert shape.code == 0
    assert "notice: cube.obj refers to cube.mtl; copy the file to" in shape.err
    kept = [line for line in file.splitlines() if not line.startswith((b"v ", b"vn"))]
    assert kept == [
        line for line in out.read_bytes().splitlines() if not line.startswith((b"v ", b"vn"))
    ]
    polygons = open_surface(out).compact()
    assert polygons.corners.reshape(-1, 4).tolist() == QUADS
    plain = run("pose", own_model, *MOVE, "-o", other)
    assert "a .ply file has triangles and positions only; write .obj" in plain.err
    np.testing.assert_allclose(read_surface(other)[0], polygons.vertices, atol=1e-12)
    assert np.abs(polygons.vertices - load(own_model).surface.source.vertices).max() > 1e-3


def test_frames_of_a_path_have_the_format_of_the_file(run: Run, own_model: Path) -> None:
    frames = own_model.parent / "frames"
    assert run("pose", own_model, *MOVE, "--path", 3, "-o", frames).code == 0
    files = sorted(frames.iterdir())
    assert [file.name for file in files] == [f"frame-000{k}.obj" for k in range(3)]
    first, last = (open_surface(file) for file in (files[0], files[-1]))
    assert first.data.count(b"usemtl") == last.data.count(b"usemtl") == 2
    np.testing.assert_allclose(first.compact().vertices, load(own_model).surface.source.vertices)


@pytest.mark.parametrize("kind", ["glb", "stl binary"])
def test_another_surface_can_be_moved(run: Run, model: Path, tmp_path: Path, kind: str) -> None:
    """It follows the tets that it lies in, even if the model was made without any surface."""
    file = write_file(tmp_path, kind)
    out, tets = tmp_path / f"out{file.suffix}", tmp_path / "out.vtu"
    assert run("pose", model, *MOVE, "--surface", file, "-o", out).code == 0
    assert run("pose", model, *MOVE, "-o", tets).code == 0
    mesh = load(model).problem.mesh
    embedded = embed_surface(*read_surface(file), mesh)
    expected = embedded.vertices(read_tets(tets).vertices)
    found, faces = read_surface(out)
    np.testing.assert_allclose(found, expected, atol=1e-6)
    assert np.array_equal(faces, embedded.faces)


def test_a_blend_writes_the_first_pose(run: Run, surface_words: list[object]) -> None:
    folder = Path(str(surface_words[1])).parent
    rest = folder / "rest.obj"
    rest.write_bytes(b"# mine\no Bar\n" + rest.read_bytes())
    path, out = folder / "b.snapspace", folder / "out.obj"
    assert run(*surface_words, "-o", path).code == 0
    assert run("blend", path, "--weights", "0,1,0", "-o", out).code == 0
    assert out.read_bytes().startswith(b"# mine\no Bar\nv ")
    assert np.array_equal(read_surface(out)[1], read_surface(rest)[1])


@pytest.mark.parametrize(("face", "says"), [("", False), (" 0.5 0.5 0.5", True)])
def test_a_file_of_triangles_and_positions_loses_nothing_in_another_format(
    run: Run, model: Path, tmp_path: Path, face: str, says: bool
) -> None:
    """Colours of faces are more."""
    file = tmp_path / "one.off"
    file.write_text(f"OFF\n3 1 0\n1 0 0\n1.5 0 0\n1 0.5 0\n3 0 1 2{face}\n")
    result = run("pose", model, *MOVE, "--surface", file, "-o", tmp_path / "out.obj")
    assert result.code == 0
    assert ("write .off to keep all that one.off has" in result.err) is says


def test_mistakes_are_named(run: Run, model: Path, own_model: Path, tmp_path: Path) -> None:
    out = tmp_path / "out.gltf"
    text = "a .gltf file is written only in place of the surface that the model was made from"
    assert f"{out}: {text}, but this one has no surface file; give --surface FILE.gltf" in run(
        "pose", model, *MOVE, "-o", out).error  # fmt: skip
    assert "this one has cube.obj; " in run("pose", own_model, *MOVE, "-o", out).error
    far = tmp_path / "far.obj"
    far.write_text("v 90 0 0\nv 91 0 0\nv 90 1 0\nf 1 2 3\n")
    error = run("pose", model, *MOVE, "--surface", far, "-o", tmp_path / "out.obj").error
    assert error.startswith(f"{far}: embed_surface: vertex 0 lies 86")
