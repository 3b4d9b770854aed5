"""Every reader refuses impossible indices and coordinates, in one line."""

from __future__ import annotations

from pathlib import Path

import pytest

from snapspace.mesh import read_surface, read_tets

OBJ = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 {}\n"
OFF = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 {}\n"
PLY = (
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\n"
    "property double z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0\n1 0 0\n0 1 {y}\n{size} 0 1 {index}\n"
)


def ply(*, y: str = "0", size: str = "3", index: str = "2") -> str:
    return PLY.format(y=y, size=size, index=index)


MESH = (
    "MeshVersionFormatted 2\nDimension 3\nVertices\n4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n"
    "Tetrahedra\n1\n1 2 3 {} 0\n"
)
VEG = "*VERTICES\n4 3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n*ELEMENTS\nTET\n1 4\n1 1 2 3 {}\n"
HUGE = "12345678901234567890"

CASES = {
    "obj, 20 digits": ("a.obj", OBJ.format(HUGE), f"has vertex index {int(HUGE) - 1}, too large"),
    "obj, below -2^63": ("a.obj", OBJ.format("-9223372036854775812"), "too large a number"),
    "obj, 33 bits": ("a.obj", OBJ.format("8589934592"), "vertex index 8589934592, but the"),
    "obj, 5000 digits": ("a.obj", OBJ.format("9" * 5000), "is not a corner of a face"),
    "off, 20 digits": ("a.off", OFF.format(HUGE), f"vertex index {HUGE}, too large a number"),
    "off, below -2^63": ("a.off", OFF.format("-9223372036854775809"), "too large a number"),
    "off, 33 bits": ("a.off", OFF.format("-8589934592"), "does not fit in 32 bits"),
    "ply, infinite index": ("a.ply", ply(index="1e400"), "vertex_indices: inf is not a whole"),
    "ply, no number": ("a.ply", ply(index="nan"), "vertex_indices: nan is not a whole"),
    "ply, half an index": ("a.ply", ply(index="1.5"), "vertex_indices: 1.5 is not a whole"),
    "ply, 20 digits": ("a.ply", ply(index=HUGE), "vertex_indices: 1.23457e+19 is not a whole"),
    "ply, infinite list": ("a.ply", ply(size="1e400"), "a list is announced with inf values"),
    "ply, half a list": ("a.ply", ply(size="3.5"), "a list is announced with 3.5 values"),
    "ply, long list": ("a.ply", ply(size="1e300"), "it is incomplete"),
    "ply, faces without bytes": (
        "a.ply",
        PLY[: PLY.index("element face")] + f"element face {2**63}\nend_header\n" + "0 0 0\n" * 3,
        "its faces have no vertex_indices",
    ),
    "ply, coordinate": ("a.ply", ply(y="1e400"), "vertex 2 is not finite"),
    "mesh, 20 digits": ("a.mesh", MESH.format(HUGE), "tetrahedra: 1.23457e+19 is not a whole"),
    "mesh, infinite": ("a.mesh", MESH.format("1e400"), "tetrahedra: inf is not a whole"),
    "veg, 20 digits": ("a.veg", VEG.format(HUGE), "elements: 1.23457e+19 is not a whole"),
}


@pytest.mark.parametrize(("name", "text", "message"), CASES.values(), ids=CASES)
@pytest.mark.filterwarnings("error")
def test_the_error_is_one_line_that_names_the_number(
    tmp_path: Path, name: str, text: str, message: str
) -> None:
    (tmp_path / name).write_text(text)
    read = read_surface if name.endswith(("obj", "off", "ply")) else read_tets
    with pytest.raises(ValueError) as caught:
        read(tmp_path / name)
    error = str(caught.value)
    assert error.startswith(str(tmp_path / name)) and "\n" not in error
    assert message in error


def test_with_a_valid_number_the_files_are_read(tmp_path: Path) -> None:
    for name, text in (("a.obj", OBJ.format(3)), ("a.off", OFF.format(2)), ("a.ply", ply())):
        (tmp_path / name).write_text(text)
        assert read_surface(tmp_path / name)[1].tolist() == [[0, 1, 2]]
    for name, text in (("a.mesh", MESH.format(4)), ("a.veg", VEG.format(4))):
        (tmp_path / name).write_text(text)
        assert len(read_tets(tmp_path / name).tets) == 1
