"""Formats with our own readers: what they accept, and a planted fault for each check."""

from __future__ import annotations

from pathlib import Path

import pytest

from snapspace.mesh import read_tets


def test_medit_version_1_keeps_all_digits(tmp_path: Path) -> None:
    """In single precision, which the header allows, this sliver would be flat or inverted."""
    text = """MeshVersionFormatted 1 Dimension
    3  # a comment
    Vertices 4
    0 0 0.1 7
    1 0 0.1 7
    0 1 0.1 7
    0.3 0.3 0.100000001 7
    Triangles 1
    1 2 3 0
    Tetrahedra
    1
    1 2 3 4 5
    End"""
    (tmp_path / "a.mesh").write_text(text)
    assert read_tets(tmp_path / "a.mesh").volume == pytest.approx(1e-9 / 6, rel=1e-6)


@pytest.mark.parametrize("base", [0, 1])
def test_tetgen_files_of_both_numberings_with_attributes(tmp_path: Path, base: int) -> None:
    points = "".join(
        f"  {i + base}\t{x} {y} {z}  0.5 1 # mark\n"
        for i, (x, y, z) in enumerate([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)])
    )
    corners = " ".join(str(base + i) for i in range(4))
    (tmp_path / "a.1.node").write_text("# nodes\n\n4  3  1  1\n" + points + "# by tetgen\n")
    (tmp_path / "a.1.ele").write_text(f"1  4  1\n {base}  {corners}  7\n# by tetgen\n")
    for suffix in (".node", ".ele"):
        assert read_tets(tmp_path / f"a.1{suffix}").volume == pytest.approx(1 / 6)


@pytest.mark.parametrize(
    ("node", "ele", "message"),
    [
        ("1 3 0 0\n1 0 0 0\n", "1 10 0\n1 1 1 1 1 1 1 1 1 1 1\n", "higher-order tets"),
        ("1 3 0 0\n1 0 0 0\n", "1 5 0\n1 1 1 1 1 1\n", "elements have 5 corners; 4 are needed"),
        ("1 2 0 0\n1 0 0\n", "0 4 0\n", "vertices have 3 numbers in a row; 4 are needed"),
        ("1 3 0 0\n1 0 0 0\n", "2 4 0\n1 1 1 1 1\n", "2 tets are announced, but the file holds 1"),
        ("1 3 0 0\n1 0 0 0\n", "1 4 0\n1 1 1 1 0\n", "tet 0 has vertex index -1"),
        ("1 3 0 0\n1 0 0 0\n", "1 4 0\n1 1 1 1 1.5\n", "1.5 is not a whole number"),
    ],
)  # fmt: skip
def test_planted_faults_in_tetgen_files(tmp_path: Path, node: str, ele: str, message: str) -> None:
    (tmp_path / "a.node").write_text(node)
    (tmp_path / "a.ele").write_text(ele)
    with pytest.raises(ValueError, match=message):
        read_tets(tmp_path / "a.node")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("Dimension 3", "does not begin with MeshVersionFormatted"),
        ("MeshVersionFormatted 2 Dimension 2 Vertices 1 0 0 0", "it is 2-dimensional"),
        ("MeshVersionFormatted 2 Dimension 3 Tetrahedra 0", "it has no Vertices"),
        ("MeshVersionFormatted 2 Dimension 3 Vertices", "no number follows vertices"),
        ("MeshVersionFormatted 2 Dimension 3 Vertices -4", "the number of vertices is -4"),
        ("MeshVersionFormatted 2 Dimension 3 Vertices 1.5", "1.5 is not a whole number"),
        ("MeshVersionFormatted 2 Dimension 3 Vertices 1 0 0 1,5 0", "'1,5' is not a number"),
        ("MeshVersionFormatted 2 Dimension 3 Vertices 2 0 0 0 0", "2 vertices are announced, but"),
        ("MeshVersionFormatted 2 Dimension 3 Vertices 1 0 0 0 0 9", "file holds more numbers"),
        ("MeshVersionFormatted 2 Dimension 3 Vertices 1 nan 0 0 0 Tetrahedra 1 1 1 1 1 0",
         r"vertex 0 is not finite \(nan, 0, 0\)"),
        ("MeshVersionFormatted 2 Dimension 3 Vertices 1 0 0 0 0 Tetrahedra 1 1 1 1 9 0",
         "tet 0 has vertex index 8, but vertices has 1 rows"),
    ],
)  # fmt: skip
def test_planted_faults_in_medit_files(tmp_path: Path, text: str, message: str) -> None:
    (tmp_path / "a.mesh").write_text(text)
    with pytest.raises(ValueError, match=message):
        read_tets(tmp_path / "a.mesh")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("*VERTICES\n0\n", r"needs the sections \*VERTICES and \*ELEMENTS"),
        ("*VERTICES\n2 3\n1 0 0 0\n*ELEMENTS\nTET\n", "2 vertices are announced, but the file ho"),
        ("*VERTICES\n2 3\n1 0 0 0\n3 0 0 0\n*ELEMENTS\nTET\n", "not numbered consecutively"),
        ("*VERTICES\n2 3\n1 0 0 0\n2 0 0\n*ELEMENTS\nTET\n", "do not all have 4 numbers in a row"),
        ("*VERTICES\n1 3\n1 0 0\n*ELEMENTS\nTET\n", "vertices have 3 numbers in a row; 4 are nee"),
        ("*VERTICES\n1 3\n1 0 0 x\n*ELEMENTS\nTET\n", "'x' is not a number"),
        ("*VERTICES\n0 3\n*ELEMENTS\nPRISM\n", "its elements are 'PRISM'; TET is needed"),
        ("*VERTICES\n0 3\n*ELEMENTS\nCUBIC\n1\n1 1 1 1 1 1 1 1 1\n", "solid cells other than tets"),
        ("*VERTICES\n*ELEMENTS\nTET\n", "the number of vertices is missing"),
    ],
)
def test_planted_faults_in_vega_files(tmp_path: Path, text: str, message: str) -> None:
    (tmp_path / "a.veg").write_text(text)
    with pytest.raises(ValueError, match=message):
        read_tets(tmp_path / "a.veg")
