"""Files of samples: plain safetensors, memory-mapped, and refused if a single bit has changed."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from safetensors.numpy import load_file

from snapspace.snapshots.sample_file import read_indices, read_samples, write_samples

from .samples import displacements, report

FloatArray = NDArray[np.float64]
INDICES = [7, 3, 11]
ROWS = displacements(3, 12)


def written(folder: Path) -> Path:
    path = folder / "samples.safetensors"
    write_samples(path, INDICES, ROWS, [report(i) for i in INDICES])
    return path


def test_everything_is_read_again_bit_by_bit(tmp_path: Path) -> None:
    path = written(tmp_path)
    assert read_indices(path) == INDICES
    found = read_samples(path)
    assert list(found) == INDICES
    for index, row in zip(INDICES, ROWS, strict=True):
        np.testing.assert_array_equal(found[index][0], row)
        assert found[index][1] == report(index)
    assert list(tmp_path.iterdir()) == [path], "no temporary file is left"


def test_any_reader_of_safetensors_reads_it(tmp_path: Path) -> None:
    arrays = load_file(written(tmp_path))
    np.testing.assert_array_equal(arrays["indices"], INDICES)
    np.testing.assert_array_equal(arrays["displacements"], ROWS)


def test_rows_are_views_of_the_file(tmp_path: Path) -> None:
    """Reading makes no copy: rows show changes of the file, and are read-only."""
    path = written(tmp_path)
    row = read_samples(path)[11][0]
    assert type(row) is np.ndarray
    assert row.ctypes.data % 8 == 0
    with pytest.raises(ValueError, match="read-only"):
        row[0] = 1.0
    with path.open("r+b") as file:
        file.seek(-8, 2)
        file.write(np.float64(42.0).tobytes())
    assert row[-1] == 42.0


def test_where_files_cannot_be_mapped_rows_are_in_memory(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refused(*_: Any, **__: Any) -> None:
        raise OSError(24, "Too many open files")

    path = written(tmp_path)
    monkeypatch.setattr(np, "memmap", refused)
    found = read_samples(path)
    path.unlink()
    np.testing.assert_array_equal([found[i][0] for i in INDICES], ROWS)


@settings(max_examples=80)
@given(data=st.data())
def test_any_changed_bit_is_noticed(data: st.DataObject) -> None:
    with tempfile.TemporaryDirectory() as folder:
        path = written(Path(folder))
        content = bytearray(path.read_bytes())
        position = data.draw(st.integers(0, 8 * len(content) - 1))
        content[position // 8] ^= 1 << position % 8
        path.write_bytes(content)
        with pytest.raises(ValueError):
            read_samples(path)


@settings(max_examples=50)
@given(data=st.data())
def test_any_missing_or_additional_byte_is_noticed(data: st.DataObject) -> None:
    with tempfile.TemporaryDirectory() as folder:
        path = written(Path(folder))
        content = path.read_bytes()
        length = data.draw(st.integers(0, len(content) + 20).filter(lambda n: n != len(content)))
        path.write_bytes((content + bytes(20))[:length])
        for read in (read_indices, read_samples):
            with pytest.raises(ValueError, match=r"it is incomplete|not a samples file"):
                read(path)


def test_strided_and_foreign_rows_are_stored_as_numbers(tmp_path: Path) -> None:
    path = tmp_path / "samples.safetensors"
    wide = displacements(2, 24)
    write_samples(path, [0, 1], [wide[0, ::2], wide[1, ::2].astype(">f8")], [report(0), report(1)])
    found = read_samples(path)
    np.testing.assert_array_equal([found[0][0], found[1][0]], wide[:, ::2])
