"""`snapspace blend --weights`: the shapes are those of a session, in every format."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from snapspace import load, read_surface, read_tets
from snapspace.cli.files import SURFACE_OUTPUTS, TET_OUTPUTS
from snapspace.pictures import render_row

from .conftest import Run, no_such_option
from .files import POSES, contents

WEIGHTS = [0.2, 0.5, 0.3]
TEXT = "0.2,0.5,0.3"


def test_json_has_the_agreed_keys_and_the_figures_of_a_session(
    run: Run, blend_model: Path, tmp_path: Path
) -> None:
    path = tmp_path / "out.vtu"
    figures = run("blend", blend_model, "--weights", TEXT, "-o", path, "--json").json
    assert list(figures) == ["dimension", "frames", "written", "writing_seconds"]
    (frame,) = figures["frames"]
    assert list(frame) == [
        *("weights", "status", "iterations", "value", "solve_ms", "frame_ms", "volume"),
        *("inverted_tets", "certain"),
    ]
    session = load(blend_model).session()
    report = session.blend(WEIGHTS)
    assert (frame["status"], frame["iterations"]) == ("converged", report.iterations)
    assert (frame["weights"], frame["value"]) == (WEIGHTS, report.value)
    assert 0 < frame["solve_ms"] <= frame["frame_ms"]
    assert frame["volume"] == pytest.approx(read_tets(path).volume)
    assert (frame["inverted_tets"], figures["dimension"]) == (0, 8)
    assert figures["written"] == [str(path)]
    np.testing.assert_array_equal(read_tets(path).vertices, session.vertices)


def test_without_json_standard_output_stays_empty(run: Run, blend_model: Path) -> None:
    result = run("blend", blend_model, "--weights", TEXT)
    assert (result.code, result.out) == (0, "")
    assert "1, 1 converged" in result.err
    assert "nothing; -o FILE or --png FILE keeps shapes" in result.err
    assert sorted(contents(blend_model.parent)) == [blend_model.name]


@pytest.mark.parametrize("suffix", SURFACE_OUTPUTS)
def test_surfaces_are_written_by_extension(
    run: Run, blend_model: Path, tmp_path: Path, suffix: str
) -> None:
    path = tmp_path / f"out{suffix}"
    assert run("blend", blend_model, "--weights", TEXT, "-o", path).code == 0
    model = load(blend_model)
    session = model.session()
    session.blend(WEIGHTS)
    vertices, faces = read_surface(path)
    wanted = model.surface.vertices(session.vertices)
    if suffix == ".stl":  # triangles in single precision, without shared vertices
        np.testing.assert_allclose(
            vertices[faces], wanted[model.surface.faces], rtol=1e-6, atol=1e-6
        )
        return
    np.testing.assert_array_equal(vertices, wanted)
    np.testing.assert_array_equal(faces, model.surface.faces)


@pytest.mark.parametrize("suffix", TET_OUTPUTS)
def test_tets_are_written_by_extension(
    run: Run, blend_model: Path, tmp_path: Path, suffix: str
) -> None:
    path = tmp_path / f"out{suffix}"
    assert run("blend", blend_model, "--weights", TEXT, "-o", path).code == 0
    model = load(blend_model)
    session = model.session()
    session.blend(WEIGHTS)
    np.testing.assert_array_equal(read_tets(path).vertices, session.vertices)
    np.testing.assert_array_equal(read_tets(path).tets, model.problem.mesh.tets)


@pytest.mark.parametrize("pose", range(3))
def test_one_hot_weights_give_the_pose(
    run: Run, blend_model: Path, tmp_path: Path, pose: int
) -> None:
    weights = ",".join("1" if k == pose else "0" for k in range(3))
    path = tmp_path / "out.vtu"
    run("blend", blend_model, "--weights", weights, "-o", path, "--linear")
    problem = load(blend_model).problem
    wanted = problem.pose_shapes[pose]
    found = problem.aligned(read_tets(path).vertices.reshape(-1), wanted)
    # what eight modes miss of the snapshots
    np.testing.assert_allclose(found, wanted, rtol=0, atol=1e-3 * problem.mesh.diagonal)
    straight = read_tets(tmp_path / "out-linear.vtu").vertices.reshape(-1)
    np.testing.assert_array_equal(straight, wanted)


def test_the_linear_blend_is_written_beside_it(run: Run, blend_model: Path, tmp_path: Path) -> None:
    """Its rotated parts shrink; those of the elastic blend hardly do."""
    words = ("--weights", "0,0.5,0.5", "-o", tmp_path / "out.msh", "--linear", "--json")
    figures = run("blend", blend_model, *words).json
    names = ["out.msh", "out-linear.msh"]
    assert figures["written"] == [str(tmp_path / name) for name in names]
    elastic, straight = (read_tets(tmp_path / name) for name in names)
    problem = load(blend_model).problem
    np.testing.assert_array_equal(straight.vertices, problem.linear_blend([0, 0.5, 0.5]))
    volume = problem.poses.volumes.sum(axis=1)[1:].mean()
    assert straight.volume < 0.93 * volume < 0.97 * volume < elastic.volume


def test_leading_modes(run: Run, blend_model: Path, tmp_path: Path) -> None:
    words = ("--weights", TEXT, "--dimension", 3, "-o", tmp_path / "out.vtu", "--json")
    assert run("blend", blend_model, *words).json["dimension"] == 3
    session = load(blend_model).leading(3).session()
    session.blend(WEIGHTS)
    np.testing.assert_array_equal(read_tets(tmp_path / "out.vtu").vertices, session.vertices)


def test_a_picture(
    run: Run, blend_model: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def small(*arguments: Any, **options: Any) -> Any:
        return render_row(*arguments, **options, size=(60, 60))

    monkeypatch.setattr("snapspace.cli.blend_picture.render_row", small)
    assert run("blend", blend_model, "--weights", TEXT, "--png", tmp_path / "out.png").code == 0
    with Image.open(tmp_path / "out.png") as image:
        assert image.width == 60
        assert len(set(image.convert("RGB").tobytes())) > 100  # shades, not one colour


@pytest.mark.parametrize("words", [("--weights", "-0.1,1.1,0"), ("--weights=-0.1 1.1 0",)])
def test_extrapolate_accepts_weights_below_zero(
    run: Run, blend_model: Path, tmp_path: Path, words: tuple[str, ...]
) -> None:
    path = tmp_path / "out.vtu"
    figures = run("blend", blend_model, *words, "--extrapolate", "-o", path, "--json").json
    assert figures["frames"][0]["weights"] == [-0.1, 1.1, 0]
    session = load(blend_model).session()
    session.blend([-0.1, 1.1, 0], extrapolate=True)
    np.testing.assert_array_equal(read_tets(path).vertices, session.vertices)


def test_a_shape_without_a_minimum_is_refused(run: Run, blend_model: Path, tmp_path: Path) -> None:
    words = ("--weights", "30,-29,0", "--extrapolate", "-o", tmp_path / "out.obj")
    error = run("blend", blend_model, *words).error
    assert error.startswith("--weights 30,-29,0: the energy has no minimum that far outside")
    assert not (tmp_path / "out.obj").exists()


def test_info_shows_the_poses(run: Run, blend_model: Path) -> None:
    result = run("info", blend_model, "--json")
    figures, model = result.json, load(blend_model)
    assert (figures["kind"], figures["problem"]) == ("model", "interpolation")
    assert (figures["dimension"], figures["parameters"]) == (8, 3)
    assert tuple(pose["name"] for pose in figures["poses"]) == POSES
    for pose, volumes in zip(figures["poses"], model.problem.poses.volumes, strict=True):
        assert pose["volume"] == pytest.approx(volumes.sum())
        assert pose["inverted_tets"] == 0
        assert 0 < pose["distance"] < 0.2
    surface = model.surface
    assert figures["surface"] == {"vertices": len(surface.corners), "faces": len(surface.faces)}
    assert figures["provenance"] == model.provenance
    assert figures["mesh"]["tets"] == 192
    assert "weights that sum to one" in result.err


def test_validate_gives_the_keys_of_a_posing_model(
    run: Run, blend_model: Path, model: Path
) -> None:
    figures = run("validate", blend_model, "--samples", 4, "--json").json
    assert list(figures) == list(run("validate", model, "--samples", 2, "--json").json)
    assert (figures["samples"], figures["dimension"]) == (4, 8)
    assert figures["projection_error"]["max"] <= figures["error"]["max"] < 0.01
    # the subspace is smaller, so its minimum is not below the full one
    assert 1 - 1e-6 < figures["energy_ratio"]["mean"] < 1.01


REFUSED: dict[str, tuple[list[str], str]] = {
    "neither": ([], "give either --weights or --path"),
    "both": (["--weights", TEXT, "--path", "3"], "give either --weights or --path"),
    "format of one file": (
        ["--weights", TEXT, "--format", "ply"],
        "--format is for --path; the ext",
    ),
    "format of nothing": (["--format", "ply"], "give either --weights or --path"),
    "count": (["--weights", "1,0"], "3 poses need 3 weights, got 2"),
    "sum": (["--weights", "0.5,0.5,0.1"], "sum to 1.1, but they must sum to 1; divide them"),
    "negative": (["--weights", "-0.1,1.1,0"], "-0.1 is below 0, the least weight that was sampled"),
    "words": (["--weights", "a,b,c"], "'--weights': 'a,b,c' is not numbers such as 0.2,0.8"),
    "nothing": (["--weights", ","], "'--weights': ',' is not numbers"),
    "a gap": (["--weights", "0.2,,0.8"], "'--weights': '0.2,,0.8' is not numbers"),
    "nan": (["--weights", "nan,0,1"], "'--weights': 'nan,0,1' is not finite"),
    "sum when extrapolating": (["--weights", "2,0,0", "--extrapolate"], "weights sum to 2"),
    "even of one shape": (
        ["--weights", TEXT, "--even", "shape"],
        "--even is for --path; ",
    ),
    "one frame": (["--path", "1"], "'--path': 1 is not in the range 2<=x<=1000000"),
    "format": (["--path", "3", "--format", "jpg"], "'--format': 'jpg' is not one of"),
    "extension": (["--weights", TEXT, "-o", "out.xyz"], "unknown extension '.xyz'; known are .obj"),
    "folder": (["--weights", TEXT, "-o", "none/out.obj"], "there is no folder none; create it"),
    "file as folder": (["--path", "3", "-o", "good.obj"], "good.obj: frames go to a film (.gif,"),
    "picture": (["--weights", TEXT, "--png", "out.jpg"], "out.jpg: unknown extension '.jpg'"),
    "picture's folder": (
        ["--path", "3", "-o", "new", "--png", "none/out.png"],
        "none/out.png: there is no folder none",
    ),
    "dimension": (["--weights", TEXT, "--dimension", "9"], "--dimension is 9, but"),
    "usage": (["--angle", "3"], no_such_option("--angle")),
}


@pytest.mark.parametrize("name", REFUSED)
def test_refusals_are_one_line_and_touch_nothing(
    run: Run, blend_model: Path, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    words, message = REFUSED[name]
    monkeypatch.chdir(blend_model.parent)
    Path("good.obj").write_text("what was there before")
    output = [] if "-o" in words else ["-o", "new" if "--path" in words else "good.obj"]
    before = contents(blend_model.parent)
    assert message in run("blend", blend_model, *words, *output, "--json").error
    assert contents(blend_model.parent) == before
    assert not Path("new").exists()


def test_each_kind_of_model_has_its_command(
    run: Run, blend_model: Path, model: Path, tmp_path: Path
) -> None:
    output = ("-o", tmp_path / "frames")
    error = run("blend", model, "--path", 3, *output).error
    assert error == f"{model}: this model has handles and no poses to blend; use `snapspace pose`"
    error = run("pose", blend_model, "-o", tmp_path / "out.obj").error
    assert error == (
        f"{blend_model}: this model interpolates poses and has no handles; use `snapspace blend`"
    )
    assert sorted(contents(tmp_path)) == sorted([model.name, blend_model.name])
    assert not (tmp_path / "frames").exists()


@pytest.mark.parametrize("damage", [b"", b"solid cube\n" * 50])
def test_a_file_that_is_not_a_model_is_refused(run: Run, blend_model: Path, damage: bytes) -> None:
    blend_model.write_bytes(damage)
    error = run("blend", blend_model, "--weights", TEXT).error
    assert error.startswith(f"{blend_model}: ")
    assert "not a complete snapspace model" in error


def test_a_missing_model(run: Run, tmp_path: Path) -> None:
    error = run("blend", tmp_path / "none.snapspace", "--path", 3, "-o", tmp_path / "new").error
    assert "none.snapspace: there is no such" in error
    assert not (tmp_path / "new").exists()
