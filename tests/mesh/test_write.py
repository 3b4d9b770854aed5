"""write_tets and write_surface: files come back exactly; failures leave old files alone."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import meshio
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from snapspace.disk.atomic_file import atomic_file
from snapspace.mesh import MeshNotice, read_surface, read_tets, write_surface, write_tets

from .boxes import box_mesh, irregular_mesh

TET_NAMES = ["a.msh", "a.vtu", "a.vtk", "a.mesh"]
SURFACE_NAMES = ["a.obj", "a.off", "a.ply", "a.stl"]


@pytest.mark.parametrize("name", TET_NAMES)
def test_tets_come_back_exactly(
    tmp_path: Path, name: str, capfd: pytest.CaptureFixture[str]
) -> None:
    mesh = irregular_mesh()
    write_tets(tmp_path / name, mesh)
    assert read_tets(tmp_path / name).fingerprint == mesh.fingerprint
    assert [file.name for file in tmp_path.iterdir()] == [name]
    assert capfd.readouterr() == ("", "")


@pytest.mark.parametrize("name", TET_NAMES)
def test_a_deformed_shape_is_written_in_place_of_the_rest_shape(tmp_path: Path, name: str) -> None:
    mesh = irregular_mesh()
    write_tets(tmp_path / name, mesh, vertices=mesh.vertices * [1, 2, 3])
    deformed = read_tets(tmp_path / name)
    assert np.array_equal(deformed.vertices, mesh.vertices * [1, 2, 3])
    assert np.array_equal(deformed.tets, mesh.tets)


@pytest.mark.parametrize("name", ["a.msh", "a.vtu", "a.vtk"])
def test_point_data_are_written(tmp_path: Path, name: str) -> None:
    mesh = irregular_mesh()
    data = {"displacement": mesh.vertices * 0.1, "mass": mesh.vertex_masses}
    write_tets(tmp_path / name, mesh, point_data=data)
    content = meshio.read(tmp_path / name)
    for key, values in data.items():
        assert np.array_equal(np.squeeze(content.point_data[key]), values)
    assert read_tets(tmp_path / name).fingerprint == mesh.fingerprint


def test_msh_is_gmsh_4_1_with_one_volume(tmp_path: Path) -> None:
    mesh = irregular_mesh()
    write_tets(tmp_path / "a.msh", mesh)
    assert (tmp_path / "a.msh").read_bytes().startswith(b"$MeshFormat\n4.1 1 8\n")
    content = meshio.read(tmp_path / "a.msh")
    assert np.unique(content.point_data["gmsh:dim_tags"], axis=0).tolist() == [[3, 1]]
    assert set(content.cell_data["gmsh:geometrical"][0]) == {1}


@pytest.mark.parametrize("name", [*TET_NAMES, *SURFACE_NAMES])
def test_writing_twice_gives_the_same_bytes(tmp_path: Path, name: str) -> None:
    mesh = irregular_mesh()
    files = [tmp_path / name, tmp_path / ("again" + name)]
    for file in files:
        if name in TET_NAMES:
            write_tets(file, mesh)
        else:
            write_surface(file, mesh.vertices, mesh.surface)
    assert files[0].read_bytes() == files[1].read_bytes()


@pytest.mark.parametrize("name", SURFACE_NAMES)
def test_surfaces_come_back_with_used_vertices_only(tmp_path: Path, name: str) -> None:
    mesh = box_mesh((3, 3, 3), (0.3, 0.7, 1.1))
    write_surface(tmp_path / name, mesh.vertices, mesh.surface)
    vertices, faces = read_surface(tmp_path / name)
    precision = 1e-7 if name == "a.stl" else 0
    assert len(vertices) == len(mesh.surface_vertices)
    assert np.abs(vertices[faces] - mesh.vertices[mesh.surface]).max() <= precision
    if name != "a.stl":
        assert np.array_equal(vertices, mesh.vertices[mesh.surface_vertices])


@settings(max_examples=50)
@given(arrays(np.float64, (3, 3), elements=st.floats(allow_nan=False, allow_infinity=False)))
def test_text_keeps_every_digit_of_every_number(
    tmp_path_factory: pytest.TempPathFactory, vertices: np.ndarray[Any, Any]
) -> None:
    folder = tmp_path_factory.mktemp("digits")
    for name in ("a.obj", "a.off", "a.ply"):
        write_surface(folder / name, vertices, [[0, 1, 2]])
        assert np.array_equal(read_surface(folder / name)[0], vertices)


def test_refuses_wrong_paths(tmp_path: Path) -> None:
    mesh = box_mesh()
    with pytest.raises(ValueError, match=r"a\.obj: unknown extension '\.obj'; known are \.msh, "):
        write_tets(tmp_path / "a.obj", mesh)
    with pytest.raises(ValueError, match=r"a\.msh: unknown extension '\.msh'; known are \.obj, "):
        write_surface(tmp_path / "a.msh", mesh.vertices, mesh.surface)
    with pytest.raises(ValueError, match=r"there is no folder .*none; create it first"):
        write_tets(tmp_path / "none" / "a.msh", mesh)
    with pytest.raises(ValueError, match="this is a folder; give a file name"):
        (tmp_path / "a.ply").mkdir()
        write_surface(tmp_path / "a.ply", mesh.vertices, mesh.surface)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (
            {"vertices": np.zeros((4, 3))},
            r"vertices must have shape \(27, 3\), like .*got \(4, 3\)",
        ),
        ({"vertices": np.full((27, 3), np.nan)}, "write_tets: vertex 0 is not finite"),
        ({"point_data": {"u": np.zeros(4)}}, r"point_data\['u'\] must be numbers of shape \(27,\)"),
        ({"point_data": {"u": np.zeros((27, 3, 3))}}, r"float64 of shape \(27, 3, 3\)"),
        ({"point_data": {"u": np.array(["x"] * 27)}}, "must be numbers of shape"),
        ({"point_data": {"u": np.full(27, np.inf)}}, "has values that are not finite"),
        ({"point_data": {"u": np.zeros((27, 2))}}, r"2 values per vertex; \.msh takes 1, 3 or 9"),
        ({"point_data": {'a"b': np.zeros(27)}}, "such a name cannot be written"),
        ({"point_data": {"gmsh:dim_tags": np.zeros(27)}}, "such a name cannot be written"),
    ],
)
def test_refused_input_leaves_the_file_untouched(
    tmp_path: Path, options: dict[str, Any], message: str
) -> None:
    (tmp_path / "a.msh").write_text("precious")
    with pytest.raises(ValueError, match=message):
        write_tets(tmp_path / "a.msh", box_mesh(), **options)
    assert [file.read_text() for file in tmp_path.iterdir()] == ["precious"]


def test_formats_name_the_data_that_they_cannot_hold(tmp_path: Path) -> None:
    mesh = box_mesh()
    with pytest.raises(ValueError, match=r"MEDIT files hold no such data; write \.vtu"):
        write_tets(tmp_path / "a.mesh", mesh, point_data={"u": mesh.vertices})
    with pytest.raises(ValueError, match=r"cannot be written as vtk: .*spaces"):
        write_tets(tmp_path / "a.vtk", mesh, point_data={"a b": mesh.vertices})
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("vertices", "faces", "message"),
    [
        ([[0, 0, 0]], np.empty((0, 3), dtype=int), "there are no faces; at least one"),
        ([[0, 0, 0]], [[0, 0, 1]], "write_surface: face 0 has vertex index 1"),
        ([[0, 0, np.nan]], [[0, 0, 0]], "write_surface: vertex 0 is not finite"),
        ([[0, 0]], [[0, 0, 0]], r"vertices must have shape \(n, 3\)"),
        ([[0, 0, 0]], [[0.0, 0, 0]], "faces must be integers"),
    ],
)
def test_refuses_wrong_surfaces(tmp_path: Path, vertices: Any, faces: Any, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        write_surface(tmp_path / "a.obj", vertices, faces)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("error", [OSError(28, "No space left on device"), KeyboardInterrupt()])
def test_a_failure_half_way_leaves_nothing_behind(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, error: BaseException
) -> None:
    def half(path: Path, *_: object) -> None:
        path.write_text("half a file")
        raise error

    monkeypatch.setitem(write_surface.__globals__["_SURFACE_WRITERS"], ".obj", half)
    (tmp_path / "a.obj").write_text("precious")
    expected = ValueError if isinstance(error, OSError) else KeyboardInterrupt
    with pytest.raises(expected):
        write_surface(tmp_path / "a.obj", [[0, 0, 0]], [[0, 0, 0]])
    assert [file.read_text() for file in tmp_path.iterdir()] == ["precious"]


def test_a_link_stays_a_link(tmp_path: Path) -> None:
    (tmp_path / "target.txt").write_text("old")
    (tmp_path / "link.txt").symlink_to(tmp_path / "target.txt")
    with atomic_file(tmp_path / "link.txt") as temporary:
        assert temporary.parent == tmp_path and temporary.suffix == ".txt"
        temporary.write_text("new")
    assert (tmp_path / "link.txt").is_symlink()
    assert (tmp_path / "target.txt").read_text() == "new"


def test_a_notice_says_where_stl_loses_the_shape(
    tmp_path: Path, recwarn: pytest.WarningsRecorder
) -> None:
    """The box is at 100,000, where single precision has steps of 0.008."""
    mesh = box_mesh((2, 2, 2))
    write_surface(tmp_path / "far.ply", mesh.vertices + 1e5, mesh.surface)
    write_surface(tmp_path / "near.stl", mesh.vertices, mesh.surface)
    assert not recwarn.list
    with pytest.warns(MeshNotice, match=r"far\.stl: .stl has single precision, .* write .obj or"):
        write_surface(tmp_path / "far.stl", mesh.vertices + 1e5, mesh.surface)
