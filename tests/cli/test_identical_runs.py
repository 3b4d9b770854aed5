"""Two runs of a command write the same model; only their times differ."""

from __future__ import annotations

from pathlib import Path

import pytest
from safetensors import safe_open
from safetensors.numpy import load_file

from .conftest import Run
from .files import write_problem, write_tet_poses


def header(path: Path) -> dict[str, str]:
    with safe_open(path, framework="np") as file:
        return dict(file.metadata())


@pytest.mark.parametrize("command", ["build", "interpolate"])
def test_the_checksums_are_equal(run: Run, tmp_path: Path, command: str) -> None:
    inputs: list[object]
    if command == "build":
        inputs = ["--problem", write_problem(tmp_path), "--dimension", 4]
    else:
        inputs = [*write_tet_poses(tmp_path), "--dimension", 5]
    paths = [tmp_path / "one" / "m.snapspace", tmp_path / "two" / "m.snapspace"]
    for path in paths:
        path.parent.mkdir()
        done = run(command, *inputs, "--samples", 12, "-o", path)
        assert done.code == 0, done.err
    first, second = map(header, paths)
    differing = {key for key in first if first[key] != second[key]}
    assert differing == {"timings", "timings_checksum"}
    one, two = map(load_file, paths)
    assert all(one[name].tobytes() == two[name].tobytes() for name in one)
