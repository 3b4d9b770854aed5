"""Identical runs write identical files, except for the seconds that they took."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from safetensors import safe_open

from snapspace import PosingModel, load
from snapspace.model_file import timings

from .test_bad_files import refused, rewrite

RECORDS = st.recursive(
    st.none() | st.integers(-9, 9) | st.text(max_size=3),
    lambda inner: (
        st.lists(inner, max_size=3)
        | st.dictionaries(st.sampled_from(["seconds", "a", "pose_seconds"]), inner, max_size=3)
    ),
    max_leaves=12,
)


def header_of(path: Path) -> dict[str, str]:
    with safe_open(path, framework="np") as file:
        return dict(file.metadata())


def timed(model: PosingModel, scale: float) -> PosingModel:
    """The model of a run that took `scale` times as long."""
    record = {
        "seed": 0,
        "seconds": {"snapshots": 1.5 * scale, "basis": 0.1 * scale},
        "pose_seconds": {"tets": scale},
        "cubature": {"tets": 9, "seconds": scale},
        "fits": [{"name": "bent", "seconds": scale}, {"name": "twisted", "seconds": 2 * scale}],
    }
    return replace(model, provenance=record)


def test_runs_of_other_speed_differ_only_in_their_seconds(
    model: PosingModel, tmp_path: Path
) -> None:
    paths = [tmp_path / "one.snapspace", tmp_path / "two.snapspace"]
    for path, scale in zip(paths, (1.0, 3.0), strict=True):
        timed(model, scale).save(path)
        assert load(path).provenance == timed(model, scale).provenance
    first, second = (header_of(path) for path in paths)
    differing = {key for key in first if first[key] != second[key]}
    assert differing == {"timings", "timings_checksum"}
    begins = [8 + int.from_bytes(path.read_bytes()[:8], "little") for path in paths]
    contents = [path.read_bytes()[begin:] for path, begin in zip(paths, begins, strict=True)]
    assert contents[0] == contents[1]


def test_runs_of_the_same_speed_write_the_same_bytes(model: PosingModel, tmp_path: Path) -> None:
    paths = [timed(model, 1.0).save(tmp_path / f"{name}.snapspace") for name in "ab"]
    assert paths[0].read_bytes() == paths[1].read_bytes()


@given(record=st.dictionaries(st.sampled_from(["seconds", "b"]), RECORDS, max_size=2))
def test_split_records_are_merged_again(record: dict[str, Any]) -> None:
    rest, found = timings.split(record)
    assert "seconds" not in str(rest) or "seconds" in str(texts(record))
    assert timings.merged(rest, found) == record


def texts(value: Any) -> list[str]:
    """All strings in a record that are not keys."""
    if isinstance(value, dict):
        return [text for item in value.values() for text in texts(item)]
    if isinstance(value, list):
        return [text for item in value for text in texts(item)]
    return [value] if isinstance(value, str) else []


def without_them(header: dict[str, str]) -> None:
    del header["timings"]


def longer(header: dict[str, str]) -> None:
    header["timings"] = header["timings"].replace("1.5", "2.5")


def without_their_checksum(header: dict[str, str]) -> None:
    del header["timings_checksum"]


@pytest.mark.parametrize("change", [without_them, longer, without_their_checksum])
def test_altered_seconds_are_noticed(model: PosingModel, tmp_path: Path, change: Any) -> None:
    path = timed(model, 1.0).save(tmp_path / "m.snapspace")
    rewrite(path, lambda arrays, header: change(header))
    assert "the checksum does not match" in refused(path)


@pytest.mark.parametrize(
    "entries", ['{"entries": 7}', '{"entries": [[["no", "seconds"], 1]]}', "[" * 9999, "[]", "{}"]
)
def test_seconds_of_another_record_are_refused(saved: Path, entries: str) -> None:
    def change(arrays: dict[str, Any], header: dict[str, str]) -> None:
        header["timings"] = entries
        header["timings_checksum"] = timings._checksum(entries)

    rewrite(saved, change)
    assert "the model is inconsistent" in refused(saved)


def test_seconds_do_not_overwrite_the_record(saved: Path) -> None:
    def change(arrays: dict[str, Any], header: dict[str, str]) -> None:
        header |= timings.timing_header([[["seed"], 1]])

    rewrite(saved, change)
    assert "'seed' is not an entry with seconds" in refused(saved)


def test_files_of_older_versions_are_read(saved: Path) -> None:
    """Up to version 3 the seconds were in the record, under a single checksum."""

    def change(arrays: dict[str, Any], header: dict[str, str]) -> None:
        del header["timings"], header["timings_checksum"]
        header["version"] = "3"
        header["provenance"] = '{"seconds": 0.3}'

    rewrite(saved, change)
    assert load(saved).provenance == {"seconds": 0.3}
