"""Odd and large surfaces: each has its outcome in `check`, in filling and in the page.

What is refused is refused by every command and by the page, in one line that says why.
"""

from __future__ import annotations

import json
import shutil
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import snapspace as ss
from snapspace.filling import SurfaceFilling
from snapspace.mesh import MeshNotice
from snapspace.server.messages import Failed
from snapspace.server.settings import ServerSettings
from snapspace.server.workspace import Workspace

from ..server.test_workspace import Mailbox
from .conftest import Run
from .files import problem_content
from .odd_surfaces import ODD, Odd, ball, block

FILLED = {name: odd for name, odd in ODD.items() if odd.volume is not None}
REFUSED = {name: odd for name, odd in ODD.items() if odd.volume is None and odd.said}
COARSE = SurfaceFilling(edge_length=0.1)


def commands(file: Path, pose: Path) -> list[tuple[Any, ...]]:
    """`build` and `interpolate` for a surface and another pose of it."""
    problem, model = file.with_name("problem.json"), file.with_name("odd.snapspace")
    problem.write_text(json.dumps(problem_content()))
    build = ("build", file, "--problem", problem, "-o", model)
    return [build, ("interpolate", file, pose, "-o", model)]


def dropped_on_a_page(file: Path) -> str:
    """What the page says if it fills what is dropped on it, and does not take it as a shell."""
    mailbox, folder = Mailbox(), file.parent
    settings = ServerSettings(
        title="", up="z", token="t", folder=folder, scratch=folder, filling=COARSE
    )
    workspace = Workspace(settings, mailbox.put)
    workspace.open()
    upload = folder / "upload" / file.name
    upload.parent.mkdir()
    shutil.copy(file, upload)
    workspace.upload(upload)
    mailbox.wait_for(Failed)
    workspace.close()
    (failed,) = (message for message in mailbox.messages if isinstance(message, Failed))
    return failed.message


@pytest.mark.parametrize("odd", ODD.values(), ids=ODD)
def test_check_finds_what_is_odd_and_nothing_else(run: Run, tmp_path: Path, odd: Odd) -> None:
    ss.write_surface(tmp_path / "odd.ply", *odd.surface)
    result = run("check", tmp_path / "odd.ply", "--json")
    report = json.loads(result.out)
    found = [(finding["fault"], finding["name"]) for finding in report["findings"]]
    assert sorted(found) == sorted(
        [*((True, name) for name in odd.faults), *((False, name) for name in odd.others)]
    )
    assert (result.code, report["fine"]) == ((1, False) if odd.faults else (0, True))


@pytest.mark.parametrize("odd", FILLED.values(), ids=FILLED)
def test_what_has_an_inside_is_filled(odd: Odd) -> None:
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", MeshNotice)
        mesh = COARSE.fill(*odd.surface, stage=lambda *_: None)
    assert mesh.volume == pytest.approx(odd.volume, rel=0.1)
    if odd.said:
        assert odd.said in str(caught[0].message)


@pytest.mark.parametrize("odd", REFUSED.values(), ids=REFUSED)
def test_what_has_none_is_refused_everywhere(run: Run, tmp_path: Path, odd: Odd) -> None:
    stages: list[str] = []
    with pytest.raises(ValueError) as caught:
        COARSE.fill(*odd.surface, stage=lambda name, *_: stages.append(name))
    assert odd.said in str(caught.value)
    assert stages == ["filling"], "fTetWild could not help"
    file, pose = tmp_path / "odd.ply", tmp_path / "longer.ply"
    vertices, faces = odd.surface
    ss.write_surface(file, vertices, faces)
    ss.write_surface(pose, vertices * [1.3, 1.0, 1.0], faces)
    for words in commands(file, pose):
        assert odd.said in run(*words).error
    page = dropped_on_a_page(file)
    assert odd.said in page and str(tmp_path) not in page


@pytest.mark.parametrize("suffix", [".obj", ".off", ".ply", ".stl", ".glb", ".gltf"])
def test_an_empty_file_is_refused_everywhere(run: Run, tmp_path: Path, suffix: str) -> None:
    file = tmp_path / f"empty{suffix}"
    file.write_bytes(b"")
    for words in [("check", file), *commands(file, file)]:
        assert run(*words).error.startswith(f"{file}: it ")
    assert dropped_on_a_page(file).startswith(f"{file.name}: it ")


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2\n"),
        ("a.off", "OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n"),
        ("a.stl", "solid a\nendsolid a\n"),
    ],
)
def test_a_file_without_faces_is_refused(tmp_path: Path, name: str, text: str) -> None:
    (tmp_path / name).write_text(text)
    for read in (ss.read_surface, ss.open_surface):
        with pytest.raises(ValueError, match=r"it has no faces \([03] vertices\)"):
            read(tmp_path / name)


@pytest.mark.parametrize("scale", [1e6, 1e-6])
def test_a_model_is_the_same_in_any_unit(scale: float) -> None:
    """They may differ where the tets cut off the edges: rounding decides there."""
    assert np.abs(posed_block(scale) / scale - posed_block(1.0)).max() < 5e-3


def posed_block(scale: float) -> NDArray[np.float64]:
    """The surface of a block whose right end is lifted and turned."""
    vertices, faces = block(scale=scale)
    mesh = COARSE.fill(vertices, faces, stage=lambda *_: None)
    x = mesh.vertices[:, 0] / scale
    handles = ss.Handles([x < 0.2, x > 1.8], names=["left", "right"])
    domain = ss.HandleBox(translation=0.3 * scale, angle=0.5)
    problem = ss.PosingProblem(mesh, handles, domain=domain)
    snapshots = ss.solve_snapshots(problem, ss.sample(domain, 12, seed=0))
    subspace = ss.snapshot_pca(snapshots, dimension=8)
    session = ss.reduce(problem, subspace, snapshots=snapshots).session()
    session.move("right", euler=(0.0, 0.3, 0.0), translation=(0.0, 0.0, 0.2 * scale))
    surface = ss.embed_surface(vertices, faces, mesh, farthest=0.1)
    return np.asarray(surface.vertices(session.vertices))


def test_many_faces_are_read_and_checked(tmp_path: Path) -> None:
    """370k: `benchmarks/opening.py --rings 501` does the same with a million."""
    vertices, faces = ball(305)
    assert len(faces) > 370_000
    ss.write_surface(tmp_path / "large.ply", vertices, faces)
    report = ss.check_surface(*ss.read_surface(tmp_path / "large.ply"))
    assert {finding.name for finding in report.findings} <= {"slivers"}  # at the poles
    assert report.faces == len(faces)
    assert report.volume == pytest.approx(4.0 / 3.0 * np.pi, rel=1e-4)
