"""The C program in the docs gives the same shape as a session."""

from __future__ import annotations

import ctypes
import runpy
import subprocess
from pathlib import Path

import numpy as np
import pytest

from snapspace import PosingModel

from .library import CORE, run
from .test_c_entry import pytestmark  # noqa: F401  (only where the library can be compiled)

EXAMPLE = CORE.parent / "examples" / "c"


def test_the_example_moves_the_last_handle(
    library: ctypes.CDLL, posing_model: PosingModel, tmp_path: Path
) -> None:
    model = posing_model.save(tmp_path / "bar.snapspace")
    export = runpy.run_path(str(EXAMPLE / "export_arrays.py"))["export_arrays"]
    export(str(model), str(tmp_path / "bar.arrays"))
    shared = Path(library._name)
    program = tmp_path / "pose"
    options = ["-std=c99", "-Wall", "-Wextra", "-Werror", f"-I{CORE}"]
    run(["cc", *options, str(EXAMPLE / "pose.c"), str(shared), "-o", str(program)], "")
    motion = ["0.1", "-0.05", "0.2"]
    printed = subprocess.run(
        [program, "bar.arrays", *motion], cwd=tmp_path, check=True, capture_output=True, text=True
    ).stdout
    vertices = np.array([line.split()[1:] for line in printed.splitlines()], float)
    session = posing_model.session()
    session.move(posing_model.problem.handles.names[-1], translation=np.array(motion, float))
    expected = session.vertices
    assert np.abs(expected - posing_model.problem.mesh.vertices).max() > 0.1
    assert vertices == pytest.approx(expected, abs=1e-5)

    (tmp_path / "short.arrays").write_bytes((tmp_path / "bar.arrays").read_bytes()[:-8])
    refused = subprocess.run([program, "short.arrays", *motion], cwd=tmp_path, capture_output=True)
    assert refused.returncode == 2 and b"incomplete" in refused.stderr
    missing = subprocess.run([program, "none.arrays", *motion], cwd=tmp_path, capture_output=True)
    assert missing.returncode == 2
    assert missing.stderr == b"pose: none.arrays cannot be read; export_arrays.py writes it\n"


def test_a_model_without_an_exact_energy_is_refused_with_the_cure(
    cubature_model: PosingModel, tmp_path: Path
) -> None:
    model = cubature_model.save(tmp_path / "bar.snapspace")
    export = runpy.run_path(str(EXAMPLE / "export_arrays.py"))["export_arrays"]
    with pytest.raises(
        SystemExit, match=r'exact energy is needed; .*"material": {"model": "stvk"}'
    ):
        export(str(model), str(tmp_path / "bar.arrays"))
