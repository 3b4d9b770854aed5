"""The statements of the README and of the quickstart hold."""

from __future__ import annotations

import re
import runpy
from pathlib import Path

import numpy as np
import pytest

import snapspace as ss

ROOT = Path(__file__).parent.parent.parent
README = (ROOT / "README.md").read_text(encoding="utf-8")


def test_the_python_of_the_readme_is_the_quickstart() -> None:
    block = re.search(r"```python\n(.*?)```", README, re.DOTALL)
    assert block is not None
    example = (ROOT / "examples" / "quickstart.py").read_text(encoding="utf-8")
    code = example.split('"""')[2].strip()
    assert block.group(1).strip() == code


def test_every_file_and_folder_that_the_readme_names_exists() -> None:
    for path in re.findall(r"\]\((docs/[^)]+)\)", README):
        assert (ROOT / path).is_file(), path
    for path in re.findall(r"`((?:core|docs)/[\w./]*)`", README):
        assert (ROOT / path).exists(), path


def test_quickstart_makes_a_model_whose_head_follows_its_handle(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    result = runpy.run_path(str(ROOT / "examples" / "quickstart.py"))
    assert result["report"].converged
    problem, session = result["problem"], result["session"]
    offsets = problem.offsets([0, 0.1, 0.1, 0, 0, 0.6])
    wanted = problem.mesh.vertices[problem.pinned] + problem.target_displacements(offsets)
    miss = np.linalg.norm(session.vertices[problem.pinned] - wanted, axis=1)
    # the handles are soft constraints: they hold to a hundredth of the size
    assert np.sqrt(np.mean(miss**2)) < 0.01 * problem.mesh.diagonal
    vertices, faces = ss.read_surface(tmp_path / "creature.obj")
    assert len(faces) == len(problem.mesh.surface)
    assert np.ptp(vertices, axis=0) == pytest.approx(
        np.ptp(session.vertices[problem.mesh.surface_vertices], axis=0)
    )
