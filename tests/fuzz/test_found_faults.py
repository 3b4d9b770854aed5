"""Faults that the fuzzers found, each with the smallest file that shows it."""

from __future__ import annotations

import json
import re
import struct
from pathlib import Path

import numpy as np
import pytest

from fuzz.corpus import posing_model, posing_problem, snapshots
from snapspace import load, load_snapshots, read_problem, read_tets
from snapspace.disk.safetensors_bytes import safetensors_bytes
from snapspace.mesh.bounded_arrays import BoundedArrays
from snapspace.model_file.container import read_container, write_container
from snapspace.snapshots.snapshot_file import _checksum


@pytest.fixture(scope="module")
def cubature(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return posing_model(energy="cubature").save(tmp_path_factory.mktemp("model") / "a.snapspace")


def test_a_table_of_tets_in_a_cubature(cubature: Path, tmp_path: Path) -> None:
    """The core's error about types once filled many lines."""
    arrays, header = read_container(cubature)
    arrays["cubature_tets"] = arrays["cubature_tets"][None]
    write_container(tmp_path / "b.snapspace", arrays, header)
    with pytest.raises(ValueError, match=r"'cubature_tets' has shape \(1, \d+\), not \(\d+,\)"):
        load(tmp_path / "b.snapspace")


@pytest.mark.parametrize("entry", ["kind", "version"])
def test_line_ends_in_a_models_header(cubature: Path, tmp_path: Path, entry: str) -> None:
    arrays, header = read_container(cubature)
    write_container(tmp_path / "b.snapspace", arrays, {**header, entry: "a\nb\x1b[2J"})
    with pytest.raises(ValueError, match=re.escape(r"a\nb\x1b[2J")) as caught:
        load(tmp_path / "b.snapspace")
    assert str(caught.value).isprintable()


@pytest.mark.parametrize("name", ["parameters", "displacements"])
@pytest.mark.parametrize("change", ["missing", "empty", "flat"])
def test_samples_with_other_arrays(tmp_path: Path, name: str, change: str) -> None:
    """They once raised KeyError, or TypeError from a memory view or a length."""
    found = snapshots()
    arrays = {
        "parameters": np.asarray(found.parameters),
        "displacements": found.displacements.array(),
    }
    if change == "missing":
        del arrays[name]
    else:
        arrays[name] = arrays[name][:0] if change == "empty" else arrays[name].ravel()
    header = {
        "format": "snapspace-samples",
        "version": "1",
        "fingerprint": posing_problem().fingerprint,
        "reports": "[]",
    }
    header["crc32"] = _checksum(arrays, header)
    path = tmp_path / "a.samples"
    path.write_bytes(safetensors_bytes(arrays, header))
    with pytest.raises(ValueError, match=r"a\.samples: .*write (it|them) again"):
        load_snapshots(path, posing_problem())


def test_control_characters_in_a_problem(tmp_path: Path) -> None:
    (tmp_path / "a.json").write_text(json.dumps({"sti\fness": 1}), encoding="utf-8")
    with pytest.raises(ValueError, match=re.escape(r"unknown entry 'sti\x0cness'")):
        read_problem(tmp_path / "a.json")


def test_a_meshb_file_without_vertices(tmp_path: Path) -> None:
    """meshio gives None in place of the table, and counting its rows once raised TypeError."""
    (tmp_path / "a.meshb").write_bytes(struct.pack("<8i", 1, 2, 3, 20, 3, 54, 0, 0))
    with pytest.raises(ValueError, match=r"a\.meshb: .*its vertices are not a table"):
        read_tets(tmp_path / "a.meshb")


@pytest.mark.parametrize("version", ["2.2 0 8", "4.1 0 8"])
def test_a_huge_vertex_number_does_not_fill_the_memory(tmp_path: Path, version: str) -> None:
    nodes, elements = "1\n2000000000 0 0 0\n", "1\n1 15 2 0 0 2000000000\n"
    if version.startswith("4"):
        nodes = "1 1 2000000000 2000000000\n0 1 0 1\n2000000000\n0 0 0\n"
        elements = "1 1 1 1\n0 1 15 1\n1 2000000000\n"
    (tmp_path / "a.msh").write_text(
        f"$MeshFormat\n{version}\n$EndMeshFormat\n$Nodes\n{nodes}$EndNodes\n"
        f"$Elements\n{elements}$EndElements\n"
    )
    with pytest.raises(ValueError, match="array of 2e\\+09 entries is too large"):
        read_tets(tmp_path / "a.msh")


def test_below_the_bound_bounded_arrays_are_those_of_numpy() -> None:
    bounded = BoundedArrays()
    np.testing.assert_array_equal(bounded.full((2, 3), 7), np.full((2, 3), 7))
    np.testing.assert_array_equal(bounded.arange(2, 9, 3), np.arange(2, 9, 3))
    assert bounded.ones(3).sum() == 3 and bounded.empty(()).shape == () and bounded.pi == np.pi
    for call in (bounded.ones, bounded.empty, bounded.arange):
        with pytest.raises(ValueError, match="too large"):
            call(1 << 40)
