"""read_tets: files of other programs, repairs, and refusals."""

from __future__ import annotations

from codecs import BOM_UTF8
from pathlib import Path

import meshio
import numpy as np
import pytest

from snapspace.mesh import MeshNotice, TetMesh, read_tets, write_tets

from .boxes import box_arrays, irregular_mesh

pytestmark = pytest.mark.filterwarnings("error")

# file name, meshio's name of the format, options
MESHIO_FILES = [
    ("ascii.mesh", "medit", {}),
    ("binary.meshb", "medit", {}),
    ("v2.msh", "gmsh22", {"binary": False}),
    ("v2_binary.msh", "gmsh22", {"binary": True}),
    ("v4.msh", "gmsh", {"binary": False}),
    ("v4_binary.msh", "gmsh", {"binary": True}),
    ("ascii.vtk", "vtk", {"binary": False}),
    ("binary.vtk", "vtk", {"binary": True}),
    ("v42.vtk", "vtk42", {"binary": True}),
    ("binary.vtu", "vtu", {"binary": True}),
    ("nodes.node", "tetgen", {}),
    ("elements.ele", "tetgen", {}),
]


def write_veg(path: Path, mesh: TetMesh, *, base: int = 1) -> None:
    lines = ["# a comment", "*VERTICES", f"{len(mesh.vertices)} 3 0 0"]
    lines += [f"{i + base} {x!r} {y!r} {z!r}" for i, (x, y, z) in enumerate(mesh.vertices.tolist())]
    lines += ["", "*elements", "TET", f"{len(mesh.tets)} 4 0"]
    lines += [
        " ".join(map(str, [i + base, *row])) for i, row in enumerate((mesh.tets + base).tolist())
    ]
    lines += [
        "*MATERIAL BODY",
        "ENU, 1000, 1E7, 0.45",
        "*SET one",
        "1, 2, 3,",
        "*REGION",
        "one,BODY",
    ]
    path.write_text("\n".join(lines))


def write_with_meshio(path: Path, mesh: TetMesh, file_format: str, **options: object) -> None:
    content = meshio.Mesh(mesh.vertices, [("tetra", mesh.tets)])
    meshio.write(path, content, file_format=file_format, **options)


@pytest.mark.parametrize(("name", "file_format", "options"), MESHIO_FILES)
def test_reads_files_of_other_programs(
    tmp_path: Path, name: str, file_format: str, options: dict[str, object]
) -> None:
    mesh = irregular_mesh()
    write_with_meshio(tmp_path / name, mesh, file_format, **options)
    assert read_tets(tmp_path / name).fingerprint == mesh.fingerprint


def test_reads_ascii_vtu(tmp_path: Path) -> None:
    """A separate test, since meshio writes 12 digits there."""
    mesh = irregular_mesh()
    write_with_meshio(tmp_path / "a.vtu", mesh, "vtu", binary=False)
    read = read_tets(tmp_path / "a.vtu")
    assert np.array_equal(read.tets, mesh.tets)
    assert read.vertices == pytest.approx(mesh.vertices, rel=1e-10)


@pytest.mark.parametrize("base", [0, 1])
def test_reads_vega_files_of_both_numberings(tmp_path: Path, base: int) -> None:
    mesh = irregular_mesh()
    write_veg(tmp_path / "a.veg", mesh, base=base)
    assert read_tets(tmp_path / "a.veg").fingerprint == mesh.fingerprint


@pytest.mark.parametrize("name", ["a.veg", "a.mesh", "a.node"])
def test_texts_may_begin_with_a_byte_order_mark(tmp_path: Path, name: str) -> None:
    """Editors on Windows write one."""
    mesh, file = irregular_mesh(), tmp_path / name
    if name == "a.veg":
        write_veg(file, mesh)
    else:
        write_with_meshio(file, mesh, {"a.mesh": "medit", "a.node": "tetgen"}[name])
    content = b"\n".join(line for line in file.read_bytes().split(b"\n") if line[:1] != b"#")
    file.write_bytes(BOM_UTF8 + content)
    assert read_tets(file).fingerprint == mesh.fingerprint


def test_vega_files_may_include_others(tmp_path: Path) -> None:
    mesh = irregular_mesh()
    write_veg(tmp_path / "whole.veg", mesh)
    text = (tmp_path / "whole.veg").read_text()
    first, second = text.split("*elements\nTET\n")
    (tmp_path / "vertices.txt").write_text(first.split("*VERTICES\n")[1])
    (tmp_path / "a.veg").write_text("*VERTICES\n*INCLUDE vertices.txt\n*ELEMENTS\nTET\n" + second)
    assert read_tets(str(tmp_path / "a.veg")).fingerprint == mesh.fingerprint
    (tmp_path / "vertices.txt").unlink()
    with pytest.raises(ValueError, match=r"a\.veg: it includes vertices\.txt, which does not"):
        read_tets(tmp_path / "a.veg")
    (tmp_path / "a.veg").write_text("*INCLUDE a.veg\n")
    with pytest.raises(ValueError, match="more than 8 files deep"):
        read_tets(tmp_path / "a.veg")


def test_cells_of_lower_dimension_are_left_out(tmp_path: Path) -> None:
    mesh = irregular_mesh()
    cells = [("line", [[0, 1]]), ("triangle", mesh.surface), ("tetra", mesh.tets[:9])]
    content = meshio.Mesh(mesh.vertices, [*cells, ("tetra", mesh.tets[9:])])
    for name in ("a.vtu", "a.vtk", "a.mesh"):
        meshio.write(tmp_path / name, content)
        assert read_tets(tmp_path / name).fingerprint == mesh.fingerprint


def test_tets_inverted_throughout_are_flipped_with_a_notice(tmp_path: Path) -> None:
    mesh = irregular_mesh()
    mirrored = meshio.Mesh(mesh.vertices, [("tetra", mesh.tets[:, [1, 0, 2, 3]])])
    meshio.write(tmp_path / "a.vtu", mirrored)
    with pytest.warns(MeshNotice, match=r"a\.vtu: all 72 tets were inverted") as caught:
        flipped = read_tets(tmp_path / "a.vtu")
    assert caught[0].filename == __file__
    assert flipped.volumes == pytest.approx(mesh.volumes)


def test_repair_mends_the_mesh_and_lists_the_repairs(tmp_path: Path) -> None:
    vertices, tets = box_arrays()
    tets[3] = tets[3][[1, 0, 2, 3]]
    content = meshio.Mesh(np.concatenate([vertices, [[2, 2, 2]]]), [("tetra", tets)])
    meshio.write(tmp_path / "a.msh", content, file_format="gmsh")
    with pytest.raises(ValueError, match=r"^[^\n]*a\.msh: tet 3 .* is inverted.*--repair"):
        read_tets(tmp_path / "a.msh")
    with pytest.warns(MeshNotice) as caught:
        mesh = read_tets(tmp_path / "a.msh", repair=True)
    assert [str(w.message).rsplit(": ")[1] for w in caught] == [
        "reoriented 1 of 48 tets, which were inverted",
        "dropped 1 of 28 vertices, which belong to no tet",
    ]
    assert mesh.volume == pytest.approx(1.0)


def test_unused_vertices_are_refused_without_repair(tmp_path: Path) -> None:
    vertices, tets = box_arrays()
    content = meshio.Mesh(np.concatenate([vertices, [[2, 2, 2]]]), [("tetra", tets)])
    meshio.write(tmp_path / "a.vtk", content)
    with pytest.raises(ValueError, match=r"a\.vtk: vertex 27 belongs to no tet; 1 such vertex of"):
        read_tets(tmp_path / "a.vtk")


def test_refuses_surfaces_and_says_so(tmp_path: Path) -> None:
    mesh = irregular_mesh()
    content = meshio.Mesh(mesh.vertices, [("triangle", mesh.surface)])
    for name in ("a.vtu", "a.mesh", "a.msh"):
        meshio.write(tmp_path / name, content, file_format="gmsh" if name == "a.msh" else None)
        message = r"holds no tets \(36 vertices, 64 triangle cells\); it seems to be a surface"
        with pytest.raises(ValueError, match=message):
            read_tets(tmp_path / name)


def test_refuses_quadratic_tets_with_the_cure(tmp_path: Path) -> None:
    vertices = np.random.default_rng(0).normal(size=(10, 3))
    content = meshio.Mesh(vertices, [("tetra10", [list(range(10))])])
    meshio.write(tmp_path / "a.vtu", content)
    with pytest.raises(
        ValueError, match=r"higher-order tets .*1 tetra10 cells\); save it with lin"
    ):
        read_tets(tmp_path / "a.vtu")


def test_refuses_other_solid_cells_besides_tets(tmp_path: Path) -> None:
    """Leaving them out would leave out part of the solid."""
    vertices, tets = box_arrays()
    cells = [("tetra", tets), ("hexahedron", [[0, 1, 4, 3, 9, 10, 13, 12]])]
    meshio.write(tmp_path / "a.vtu", meshio.Mesh(vertices, cells))
    with pytest.raises(ValueError, match=r"solid cells other than tets .*split them into tets"):
        read_tets(tmp_path / "a.vtu")


def test_tetgen_needs_both_files(tmp_path: Path) -> None:
    write_with_meshio(tmp_path / "a.node", irregular_mesh(), "tetgen")
    (tmp_path / "a.ele").unlink()
    with pytest.raises(ValueError, match=r"a\.node: TetGen's a\.ele must be beside it"):
        read_tets(tmp_path / "a.node")


def test_names_the_path_that_cannot_be_read(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"missing\.mesh: there is no such file"):
        read_tets(tmp_path / "missing.mesh")
    (tmp_path / "folder.msh").mkdir()
    with pytest.raises(ValueError, match=r"folder\.msh: this is a folder"):
        read_tets(tmp_path / "folder.msh")
    with pytest.raises(ValueError, match=r"a\.xyz: unknown extension '\.xyz'; known are \.mesh, "):
        read_tets(tmp_path / "a.xyz")
    with pytest.raises(ValueError, match=r"mesh: there is no such file"):
        read_tets(tmp_path / "mesh")
    (tmp_path / "mesh").touch()
    with pytest.raises(ValueError, match=r"mesh: no extension; known are"):
        read_tets(tmp_path / "mesh")


NAMES = [*(name for name, _, _ in MESHIO_FILES), "a.veg"]


@pytest.mark.parametrize("junk", [b"", b"\n\n", b"hello world\n", bytes(range(256)) * 20])
@pytest.mark.parametrize("name", NAMES)
def test_junk_gives_one_clear_line(
    tmp_path: Path, name: str, junk: bytes, capfd: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / name
    for suffix in (".node", ".ele") if file.suffix in (".node", ".ele") else (file.suffix,):
        file.with_suffix(suffix).write_bytes(junk)
    with pytest.raises(ValueError, match=r"^[^\n]*" + file.name + r": [^\n]*$"):
        read_tets(file)
    assert capfd.readouterr() == ("", "")


@pytest.mark.parametrize("fraction", [0.05, 0.3, 0.5, 0.8])
@pytest.mark.parametrize("name", NAMES)
def test_truncated_files_give_one_clear_line(tmp_path: Path, name: str, fraction: float) -> None:
    file = tmp_path / name
    if file.suffix == ".veg":
        write_veg(file, irregular_mesh())
        data = file.read_bytes().split(b"*MATERIAL")[0]
    else:
        _, file_format, options = next(entry for entry in MESHIO_FILES if entry[0] == name)
        write_with_meshio(file, irregular_mesh(), file_format, **options)
        data = file.read_bytes()
    file.write_bytes(data[: int(fraction * len(data))])
    with pytest.raises(ValueError, match=r"^[^\n]*" + file.name + r": [^\n]*$"):
        read_tets(file)


def test_upper_case_extensions_are_known(tmp_path: Path) -> None:
    mesh = irregular_mesh()
    write_tets(tmp_path / "A.MSH", mesh)
    assert read_tets(tmp_path / "A.MSH").fingerprint == mesh.fingerprint
