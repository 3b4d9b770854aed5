"""`snapspace interpolate`: a model of the user's shapes from poses of every kind."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from safetensors.numpy import load_file

from snapspace import (
    InterpolationModel,
    TetMesh,
    load,
    read_surface,
    read_tets,
    sample,
    write_surface,
    write_tets,
)
from snapspace.fitting.targets import point_areas, registered_targets

from ..shapes import CORNER_TET, moved, one_tet, random_rotation
from .conftest import Run
from .files import (
    POSES,
    FloatArray,
    bar_mesh,
    bar_shapes,
    bar_surfaces,
    contents,
    enclosing_mesh,
    surface_first,
    write_raw,
    write_surface_poses,
    write_tet_poses,
)

SMALL = ("--samples", 6, "--dimension", 5)


def loaded(path: Path) -> InterpolationModel:
    model = load(path)
    assert isinstance(model, InterpolationModel)
    return model


def distances(shape: FloatArray, target: FloatArray, faces: Any) -> tuple[float, float]:
    """Distances of surfaces after registration: rms weighted by area, and the largest."""
    areas = point_areas(target, faces)
    squares = ((registered_targets(shape[None], target, areas)[0] - target) ** 2).sum(axis=1)
    return float(np.sqrt(areas @ squares / areas.sum())), float(np.sqrt(squares.max()))


def test_json_has_the_agreed_keys_and_plausible_figures(run: Run, tmp_path: Path) -> None:
    path = tmp_path / "m.snapspace"
    words = (*write_tet_poses(tmp_path), *SMALL, "-o", path, "--json")
    figures = run("interpolate", *words).json
    assert list(figures) == [
        *("vertices", "tets", "parameters", "samples", "dimension", "energy_fraction"),
        *("seconds", "snapshots", "unseen", "model_bytes", "peak_memory_bytes", "poses", "fits"),
    ]
    stages = ["mean shape", "snapshots", "basis", "reduction", "unseen samples"]
    assert list(figures["seconds"]) == [*stages, "total"]
    assert sum(figures["seconds"][name] for name in stages) <= figures["seconds"]["total"]
    mesh = bar_mesh()
    assert (figures["vertices"], figures["tets"]) == (len(mesh.vertices), len(mesh.tets))
    assert (figures["poses"], figures["parameters"], figures["fits"]) == (3, 3, [])
    assert (figures["samples"], figures["dimension"]) == (6, 5)
    assert 0.99 < figures["energy_fraction"] < 1
    assert figures["snapshots"]["converged"] == 6
    assert figures["model_bytes"] == path.stat().st_size


def test_without_json_standard_output_stays_empty(run: Run, tmp_path: Path) -> None:
    path = tmp_path / "m.snapspace"
    result = run("interpolate", *write_tet_poses(tmp_path), *SMALL, "-o", path)
    assert (result.code, result.out) == (0, "")
    assert "6 of 6 samples converged" in result.err
    assert f"snapspace blend {path} --weights 0.5,0.5,0 -o blend.obj" in result.err


def test_the_model_records_how_it_was_made(run: Run, tmp_path: Path) -> None:
    path = tmp_path / "m.snapspace"
    words = ("--seed", 3, "--lam", 2, "--mu", 0.5, "--extrapolation", 0.6, "-o", path)
    run("interpolate", *write_tet_poses(tmp_path), *SMALL, *words)
    model = loaded(path)
    record, problem = model.provenance, model.problem
    assert record["poses"] == [f"{name}.mesh" for name in POSES]
    assert (record["tets"], record["fits"]) == (None, [])
    assert record["sampling"]["method"] == "sobol"
    assert str(tmp_path) not in str(record)
    assert (problem.material.lam, problem.material.mu) == (2, 0.5)
    assert problem.domain.extrapolation == 0.6
    wanted = sample(problem.domain, 6, method="sobol", seed=3)
    np.testing.assert_array_equal(model.training_parameters, np.vstack([wanted, np.eye(3)]))


def test_tets_are_used_unchanged_from_any_format(run: Run, tmp_path: Path) -> None:
    write_tet_poses(tmp_path, ".mesh")
    write_tet_poses(tmp_path, ".vtu")
    poses = [tmp_path / name for name in ("rest.mesh", "bent.vtu", "twisted.mesh")]
    run("interpolate", *poses, *SMALL, "-o", tmp_path / "m.snapspace")
    model = loaded(tmp_path / "m.snapspace")
    np.testing.assert_array_equal(model.problem.poses.shapes, list(bar_shapes().values()))
    np.testing.assert_array_equal(model.problem.poses.tets, bar_mesh().tets)
    assert model.problem.poses.names == POSES
    corners = model.surface.corners[:, 0]
    np.testing.assert_array_equal(corners[model.surface.faces], bar_mesh().surface)


@pytest.mark.parametrize("tets", [surface_first(), enclosing_mesh()], ids=["exact", "enclosing"])
def test_surfaces_come_back_as_the_user_has_them(run: Run, tmp_path: Path, tets: Any) -> None:
    """Vertex order and faces are the user's; poses are met within the deviation reported."""
    write_tets(tmp_path / "tets.vtu", tets)
    path, out = tmp_path / "m.snapspace", tmp_path / "out.ply"
    # the subspace contains all snapshots, so poses are as far off as their fits
    words = ("--tets", tmp_path / "tets.vtu", "--samples", 4, "--dimension", 7, "-o", path)
    result = run("interpolate", *write_surface_poses(tmp_path), *words, "--json")
    figures = result.json
    assert figures["tets"] == len(tets.tets)
    assert [fit["name"] for fit in figures["fits"]] == ["bent", "twisted"]
    assert "fitted poses; distances relative to the diagonal" in result.err
    assert list(figures["seconds"])[:2] == ["tets", "fitting"]
    assert list(figures["seconds"])[-1] == "total"
    assert loaded(path).surface.exact == (len(tets.vertices) == len(bar_mesh().vertices))
    surfaces = list(bar_surfaces().values())
    reported = [(0.0, 0.0), *((fit["rms"], fit["max"]) for fit in figures["fits"])]
    for pose, (wanted, faces) in enumerate(surfaces):
        weights = ",".join("1" if k == pose else "0" for k in range(3))
        assert run("blend", path, "--weights", weights, "-o", out).code == 0
        vertices, found = read_surface(out)
        np.testing.assert_array_equal(found, faces)
        rms, largest = distances(vertices, wanted, faces)
        assert rms / tets.diagonal == pytest.approx(reported[pose][0], abs=1e-5)
        assert largest / tets.diagonal == pytest.approx(reported[pose][1], abs=1e-4)
    for fit in figures["fits"]:
        assert 0 < fit["rms"] <= 1e-3  # the default deviation
        assert fit["rms"] < fit["max"] < 0.01
        assert (fit["inverted_tets"], fit["status"]) == (0, "converged")
        assert 0.5 < fit["smallest_stretch"] < 1 < fit["largest_stretch"] < 2


def test_frames_and_units_of_the_poses_do_not_matter(
    run: Run, tmp_path: Path, surface_words: list[object]
) -> None:
    """The second pose is rotated and moved; the third also has another unit of length."""
    plain, other = tmp_path / "plain.snapspace", tmp_path / "other.snapspace"
    run(*surface_words, "-o", plain)
    for k, scale in ((1, 1.0), (2, 100.0)):
        vertices, faces = bar_surfaces()[POSES[k]]
        turned = scale * moved(vertices.reshape(-1), random_rotation(k), [3.0, -9.0, 2.0])
        write_surface(tmp_path / f"{POSES[k]}.obj", turned.reshape(-1, 3), faces)
    result = run(*surface_words, "-o", other)
    assert "notice: twisted is scaled by 0.01 to the size of rest" in result.err
    assert "bent is scaled" not in result.err
    first, second = loaded(plain), loaded(other)
    np.testing.assert_allclose(second.problem.tau, first.problem.tau, rtol=0, atol=1e-6)
    np.testing.assert_allclose(
        second.subspace.snapshot_energies, first.subspace.snapshot_energies, rtol=1e-4, atol=1e-9
    )
    shapes = []
    for model in (first, second):
        session = model.session()
        session.blend([0.2, 0.5, 0.3])
        shapes.append(session.vertices)
    np.testing.assert_allclose(shapes[1], shapes[0], rtol=0, atol=1e-5)


@pytest.mark.parametrize(
    ("scale", "policy", "wanted"),
    [(1.3, "auto", 1.3), (1.3, "match", 1), (100, "auto", 1), (1.3, "keep", 1.3)],
)
def test_scales(run: Run, tmp_path: Path, scale: float, policy: str, wanted: float) -> None:
    """Under auto a pose may be larger than the first one, but not by a unit of length."""
    mesh, bent = bar_mesh(), bar_shapes()["bent"]
    write_tets(tmp_path / "a.msh", mesh)
    write_tets(tmp_path / "b.msh", mesh, vertices=scale * bent)
    words = (tmp_path / "a.msh", tmp_path / "b.msh", "--samples", 2, "--dimension", 1)
    result = run("interpolate", *words, "--scale", policy, "-o", tmp_path / "m.snapspace")
    assert result.code == 0, result.err
    assert ("b is scaled by" in result.err) == (wanted != scale)
    volumes = loaded(tmp_path / "m.snapspace").problem.poses.volumes.sum(axis=1)
    alike = TetMesh(bent, mesh.tets).volume
    assert volumes[1] / alike == pytest.approx(wanted**3, rel=1e-6)
    far = abs(np.log(wanted)) > 0.2
    assert ("--scale match removes that" in result.err) == (policy == "auto" and far)


def test_a_larger_deviation_is_a_softer_fit(
    run: Run, tmp_path: Path, surface_words: list[object]
) -> None:
    path = tmp_path / "m.snapspace"
    tight, soft = (
        run(*surface_words, "--deviation", share, "-o", path, "--json").json["fits"]
        for share in (1e-3, 2e-2)
    )
    for before, after in zip(tight, soft, strict=True):
        assert before["rms"] <= 1e-3 < after["rms"] <= 2e-2
        assert after["stages"] < before["stages"]


def test_a_fit_that_misses_its_surface_gives_a_notice(run: Run, tmp_path: Path) -> None:
    """No tet may be stretched so much that the body becomes a thousandth as thick."""
    write_tets(tmp_path / "tets.mesh", surface_first())
    rest, _, twisted = write_surface_poses(tmp_path)
    vertices, faces = bar_surfaces()["twisted"]
    write_surface(twisted, vertices * [1, 1, 1e-3], faces)
    words = (rest, twisted, "--tets", tmp_path / "tets.mesh", "--samples", 2, "--dimension", 2)
    result = run(
        "interpolate", *words, "--material", "stvk", "-o", tmp_path / "m.snapspace", "--json"
    )
    (fit,) = result.json["fits"]
    assert fit["status"] != "converged"
    assert fit["inverted_tets"] == 0
    wanted = f"notice: twisted ended with {fit['status']}, {fit['rms']:.2g} from its surface"
    assert wanted in result.err
    assert "blended as it was fitted; --save-poses DIR writes that shape, and --shell" in result.err


def test_threads_do_not_change_the_model(
    run: Run, tmp_path: Path, surface_words: list[object]
) -> None:
    paths = [tmp_path / f"{threads}.snapspace" for threads in (1, 2)]
    for threads, path in enumerate(paths, start=1):
        run(*surface_words, "--threads", threads, "-o", path)
    first, second = (load_file(path) for path in paths)
    assert first.keys() == second.keys()
    for name in first:
        assert first[name].tobytes() == second[name].tobytes(), name


def test_saved_poses_can_be_used_again(
    run: Run, tmp_path: Path, surface_words: list[object]
) -> None:
    """The folder may even be that of the fits that are kept while the command runs."""
    path, again = tmp_path / "m.snapspace", tmp_path / "again.snapspace"
    folder = tmp_path / "m.snapspace.poses"
    run(*surface_words, "-o", path, "--save-poses", folder)
    saved = [folder / f"{name}.msh" for name in POSES]
    assert sorted(folder.iterdir()) == sorted(saved)
    run("interpolate", *saved, *SMALL, "-o", again)
    first, second = loaded(path), loaded(again)
    np.testing.assert_array_equal(second.problem.poses.shapes, first.problem.poses.shapes)
    np.testing.assert_array_equal(second.subspace.basis, first.subspace.basis)


def test_repair_mends_the_tets_of_the_surface(
    run: Run, tmp_path: Path, surface_words: list[object]
) -> None:
    mesh = surface_first()
    write_raw(tmp_path / "tets.mesh", mesh.vertices, np.vstack([mesh.tets, mesh.tets[:1]]))
    words = (*surface_words, "-o", tmp_path / "m.snapspace")
    assert "same four vertices" in run(*words).error
    result = run(*words, "--repair", "--json")
    assert result.json["tets"] == len(mesh.tets)
    assert result.err.count("dropped 1 of 193 tets") == 1


def test_inverted_tets_are_accepted_when_asked_for(run: Run, tmp_path: Path) -> None:
    path, poses = tmp_path / "m.snapspace", write_tet_poses(tmp_path)
    shape = bar_shapes()["bent"].copy()
    shape[40] += [0, 0, 1.5]  # one vertex is pulled through others
    write_raw(poses[1], shape, bar_mesh().tets)
    words = ("interpolate", *poses, *SMALL, "-o", path)
    assert "tets are inverted" in run(*words).error
    assert run(*words, "--accept-inverted").code == 0
    corners = shape[bar_mesh().tets]
    count = int((np.linalg.det(corners[:, 1:] - corners[:, :1]) < 0).sum())
    result = run("info", path, "--json")
    assert [pose["inverted_tets"] for pose in result.json["poses"]] == [0, count, 0]
    assert f"{count} tets inverted" in " ".join(result.err.split())


def test_with_exact_ftetwild_fills_the_first_surface(run: Run, tmp_path: Path) -> None:
    """The only run of fTetWild in these tests, on the simplest surface."""
    vertices, faces = CORNER_TET, one_tet().surface
    leaning = vertices + 0.3 * vertices[:, [2]] * [1.0, 0.0, 0.0]
    write_surface(tmp_path / "corner.off", vertices, faces)
    write_surface(tmp_path / "leaning.off", leaning, faces)
    path = tmp_path / "m.snapspace"
    words = (tmp_path / "corner.off", tmp_path / "leaning.off", "--exact", "--edge-length", 0.2)
    size = ("--samples", 2, "--dimension", 2, "-o", path, "--save-poses", tmp_path / "tets")
    figures = run("interpolate", *words, *size, "--json").json
    model = loaded(path)
    for volumes in model.problem.poses.volumes:
        assert volumes.sum() == pytest.approx(1 / 6, rel=0.02)
    assert figures["fits"][0]["rms"] <= 1e-3
    np.testing.assert_array_equal(model.surface.faces, faces)
    found = model.surface.vertices(model.problem.mesh.vertices)
    np.testing.assert_allclose(found, vertices, rtol=0, atol=1e-12)
    mesh = read_tets(tmp_path / "tets" / "corner.msh")
    assert mesh.fingerprint == model.problem.mesh.fingerprint
    left = [name for name in contents(tmp_path) if not name.startswith("tets")]
    assert left == ["corner.off", "leaning.off", "m.snapspace"]
