"""Incomplete, altered or foreign model files: one line names the file and the cure."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from safetensors import safe_open
from safetensors.numpy import load_file, save_file

from snapspace import load
from snapspace.model_file.container import checksum

Change = Callable[[dict[str, Any], dict[str, str]], None]


def refused(path: Path) -> str:
    """The message of a load that must fail: one line, naming the file, with something to do."""
    with pytest.raises(ValueError) as caught:
        load(path)
    message = str(caught.value)
    assert message.startswith(f"{path}: ")
    assert "\n" not in message
    assert re.search("build|copy|install", message), message
    return message


def rewrite(path: Path, change: Change, *, sign: bool = True) -> None:
    """Changes arrays and header of a model file; with `sign` the checksum is that of the change."""
    arrays: dict[str, Any] = load_file(path)
    with safe_open(path, framework="np") as file:
        header = dict(file.metadata())
    change(arrays, header)
    if sign:
        header["checksum"] = checksum(arrays, header)
    save_file(arrays, path, header)


def test_a_rewritten_file_is_fine_if_nothing_changed(saved: Path) -> None:
    """So the files of the other tests are refused only because of their changes."""
    rewrite(saved, lambda arrays, header: None)
    assert load(saved).dimension == 5


def test_every_truncation_is_noticed(saved: Path) -> None:
    content = saved.read_bytes()
    header = 8 + int.from_bytes(content[:8], "little")
    lengths = [0, 1, 7, 8, 9, header // 2, header - 1, header, header + 1]
    lengths += np.linspace(header, len(content) - 1, 20).astype(int).tolist()
    for length in lengths:
        saved.write_bytes(content[:length])
        assert "not a complete snapspace model" in refused(saved)


def test_extra_bytes_are_noticed(saved: Path) -> None:
    saved.write_bytes(saved.read_bytes() + b"\0" * 8)
    refused(saved)


def test_a_flipped_bit_is_noticed_wherever_it_is(saved: Path) -> None:
    """Every byte of the header, and the payload in steps that visit every array."""
    content = saved.read_bytes()
    header = 8 + int.from_bytes(content[:8], "little")
    arrays = [array.nbytes for array in load_file(saved).values()]
    step = min(size for size in arrays if size) // 2 + 1
    offsets = [*range(8, header), *range(header, len(content), step), len(content) - 1]
    bits = np.random.default_rng(0).integers(0, 8, len(offsets))
    for offset, bit in zip(offsets, bits.tolist(), strict=True):
        _put(saved, offset, content[offset] ^ 1 << bit)
        refused(saved)
        _put(saved, offset, content[offset])


def _put(path: Path, offset: int, byte: int) -> None:
    """Writes one byte in place: a whole new file for each would wait for the disk."""
    with path.open("r+b") as file:
        file.seek(offset)
        file.write(bytes([byte]))


@pytest.mark.parametrize("offset", range(8))
def test_a_wrong_header_length_is_noticed(saved: Path, offset: int) -> None:
    content = bytearray(saved.read_bytes())
    content[offset] ^= 0x55
    saved.write_bytes(content)
    refused(saved)


def test_an_altered_number_is_distinguished_from_a_broken_file(saved: Path) -> None:
    content = bytearray(saved.read_bytes())
    content[-3] ^= 1
    saved.write_bytes(content)
    assert "the checksum does not match: the file was altered; build it again" in refused(saved)


@pytest.mark.parametrize("key", ["problem", "provenance"])
def test_an_altered_header_is_noticed(saved: Path, key: str) -> None:
    def change(arrays: dict[str, Any], header: dict[str, str]) -> None:
        header[key] = header[key].replace("1234.5", "1234.4").replace('"seed": 0', '"seed": 1')

    rewrite(saved, change, sign=False)
    assert "the checksum does not match" in refused(saved)


@pytest.mark.parametrize(
    "name", ["vertices", "tets", "handle_sizes", "basis", "quartic", "handle_L"]
)
def test_a_missing_array_is_named(saved: Path, name: str) -> None:
    def change(arrays: dict[str, Any], header: dict[str, str]) -> None:
        del arrays[name]

    rewrite(saved, change)
    assert refused(saved).endswith(f"the array '{name}' is missing; build the model again")


@pytest.mark.parametrize(
    ("name", "dtype"), [("basis", "float16"), ("tets", "int64"), ("vertices", "int32")]
)
def test_a_wrong_type_is_named(saved: Path, name: str, dtype: str) -> None:
    def change(arrays: dict[str, Any], header: dict[str, str]) -> None:
        arrays[name] = arrays[name].astype(dtype)

    rewrite(saved, change)
    assert f"the array '{name}' is {dtype}, not " in refused(saved)


@pytest.mark.parametrize(
    "name", ["basis", "quartic", "handle_K", "handle_L", "handle_S", "training_coordinates"]
)
def test_a_wrong_size_is_named(saved: Path, name: str) -> None:
    def change(arrays: dict[str, Any], header: dict[str, str]) -> None:
        arrays[name] = np.ascontiguousarray(arrays[name][..., :-1])

    rewrite(saved, change)
    assert f"the model is inconsistent ('{name}' has shape" in refused(saved)


def bad_tet(arrays: dict[str, Any], header: dict[str, str]) -> None:
    arrays["tets"] = arrays["tets"].copy()
    arrays["tets"][3, 2] = 10_000


def bad_handle(arrays: dict[str, Any], header: dict[str, str]) -> None:
    arrays["handle_vertices"] = arrays["handle_vertices"] + np.int32(5000)


def bad_stiffness(arrays: dict[str, Any], header: dict[str, str]) -> None:
    header["problem"] = json.dumps({**json.loads(header["problem"]), "stiffness": -1.0})


def no_handles(arrays: dict[str, Any], header: dict[str, str]) -> None:
    header["problem"] = json.dumps({**json.loads(header["problem"]), "handles": []})


def no_material(arrays: dict[str, Any], header: dict[str, str]) -> None:
    content = json.loads(header["problem"])
    del content["material"]
    header["problem"] = json.dumps(content)


def not_json(arrays: dict[str, Any], header: dict[str, str]) -> None:
    header["problem"] = "{"


def a_list(arrays: dict[str, Any], header: dict[str, str]) -> None:
    header["problem"] = "[1, 2]"


def deep(arrays: dict[str, Any], header: dict[str, str]) -> None:
    header["problem"] = "[" * 100_000 + "]" * 100_000


def a_huge_integer(arrays: dict[str, Any], header: dict[str, str]) -> None:
    """An integer too large for a float."""
    content = {**json.loads(header["problem"]), "stiffness": 10**400}
    header["problem"] = json.dumps(content)


def more_digits_than_python_reads(arrays: dict[str, Any], header: dict[str, str]) -> None:
    header["provenance"] = f'{{"seed": {"9" * 5000}}}'


def a_list_of_records(arrays: dict[str, Any], header: dict[str, str]) -> None:
    header["provenance"] = "[]"


def handles_as_a_number(arrays: dict[str, Any], header: dict[str, str]) -> None:
    header["problem"] = json.dumps({**json.loads(header["problem"]), "handles": 7})


def bounds_as_text(arrays: dict[str, Any], header: dict[str, str]) -> None:
    header["problem"] = json.dumps({**json.loads(header["problem"]), "domain": "wide"})


def a_stiffness_that_is_nan(arrays: dict[str, Any], header: dict[str, str]) -> None:
    header["problem"] = json.dumps({**json.loads(header["problem"]), "stiffness": float("nan")})


def no_problem(arrays: dict[str, Any], header: dict[str, str]) -> None:
    del header["problem"]


@pytest.mark.parametrize(
    "change",
    [
        bad_tet,
        bad_handle,
        bad_stiffness,
        no_handles,
        no_material,
        not_json,
        a_list,
        no_problem,
        deep,
        a_huge_integer,
        more_digits_than_python_reads,
        a_list_of_records,
        handles_as_a_number,
        bounds_as_text,
        a_stiffness_that_is_nan,
    ],
)
def test_content_that_is_not_a_valid_model_is_refused(saved: Path, change: Change) -> None:
    """A valid checksum is not enough: loaded content passes the validators of its types."""
    rewrite(saved, change)
    assert "the model is inconsistent" in refused(saved)


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_a_number_that_is_not_finite_is_refused_in_any_array(saved: Path, value: float) -> None:
    """A valid checksum is not enough: the shapes would not be finite."""
    content = saved.read_bytes()
    names = [name for name, array in load_file(saved).items() if array.dtype.kind == "f"]
    assert {"vertices", "basis", "quartic", "handle_S", "training_coordinates"} <= set(names)
    for name in names:

        def change(arrays: dict[str, Any], header: dict[str, str], name: str = name) -> None:
            arrays[name] = arrays[name].copy()
            arrays[name].flat[-1] = value

        saved.write_bytes(content)
        rewrite(saved, change)
        assert f"the array '{name}' has a number at [" in refused(saved)


@pytest.mark.parametrize("version", ["5", "0", "", "one"])
def test_another_version_is_named(saved: Path, version: str) -> None:
    def change(arrays: dict[str, Any], header: dict[str, str]) -> None:
        header["version"] = version

    rewrite(saved, change)
    assert (
        f"the version is {version}, but this snapspace reads versions 1, 2, 3, 4; install"
        in refused(saved)
    )


def test_safetensors_of_another_kind_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "weights.snapspace"
    save_file({"weight": np.zeros((3, 3))}, path)
    assert "not a snapspace model; `snapspace build` makes one" in refused(path)
    save_file({"weight": np.zeros((3, 3))}, path, {"format": "pt"})
    assert "not a snapspace model" in refused(path)


@pytest.mark.parametrize("content", [b"", b"vertices 8\n", b"{}", b"\xff" * 100, b"\0" * 100])
def test_other_files_are_refused(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / "notes.snapspace"
    path.write_bytes(content)
    refused(path)


def test_a_missing_file_is_named(tmp_path: Path) -> None:
    message = refused(tmp_path / "dragon.snapspace")
    assert message.endswith("there is no such model file; `snapspace build` makes one")


def test_a_folder_is_refused(tmp_path: Path) -> None:
    refused(tmp_path)
