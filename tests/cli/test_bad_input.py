"""A mistake in the input gives one line that names it and exit code 2, and touches no file."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from .conftest import Run, no_such_option
from .files import bar_mesh, contents, problem_content, write_problem, write_raw

Case = Callable[[Path], list[object]]


def build(folder: Path, *words: object, **changes: object) -> list[object]:
    """A build whose problem file has these changes."""
    problem = write_problem(folder, "changed.json", **changes)
    return ["build", "--problem", problem, "-o", folder / "new.snapspace", *words]


def nan_in_the_mesh(folder: Path) -> list[object]:
    mesh = bar_mesh()
    vertices = mesh.vertices.copy()
    vertices[3, 1] = np.nan
    write_raw(folder / "nan.mesh", vertices, mesh.tets)
    return build(folder, folder / "nan.mesh")


def picture_as_mesh(folder: Path) -> list[object]:
    (folder / "picture.png").write_bytes(b"no mesh")
    return build(folder, folder / "picture.png")


def not_json(folder: Path) -> list[object]:
    (folder / "broken.json").write_text('{"mesh": "bar.msh",')
    return ["info", folder / "broken.json"]


def folder_as_output(folder: Path) -> list[object]:
    (folder / "folder.snapspace").mkdir()
    return [*build(folder), "-o", folder / "folder.snapspace"]


def handles(*names: str) -> list[object]:
    both = problem_content()["handles"]
    return [{**handle, "name": name} for handle, name in zip(both, names, strict=True)]


def overlapping() -> list[object]:
    both = problem_content()["handles"]
    return [both[0], {"name": "all", "boxes": [[[None] * 3, [None] * 3]]}]


def material(**changes: object) -> dict[str, object]:
    return {"model": "stvk", "lam": 1.0, "mu": 1.0, **changes}


BUILDS: dict[str, tuple[Case, str]] = {
    "no problem file": (
        lambda f: ["build", "--problem", f / "none.json", "-o", f / "new.snapspace"],
        "none.json: there is no such problem file",
    ),
    "mesh as problem": (
        lambda f: [
            "build",
            "--problem",
            write_problem(f).with_name("bar.msh"),
            "-o",
            f / "m.snapspace",
        ],
        "bar.msh: this is a tet mesh, but a problem (.json) is needed, which names the mesh",
    ),
    "no mesh file": (lambda f: build(f, mesh="none.msh"), "none.msh: there is no such file"),
    "no mesh argument": (lambda f: build(f, f / "none.vtu"), "none.vtu: there is no such file"),
    "unknown extension": (
        lambda f: build(f, mesh="bar.xyz"),
        "bar.xyz: unknown extension '.xyz'; known are .mesh",
    ),
    "picture as mesh": (picture_as_mesh, "picture.png: unknown extension '.png'"),
    "nan in the mesh": (nan_in_the_mesh, "nan.mesh: vertex 3 is not finite"),
    "unknown entry": (lambda f: build(f, colour="red"), "unknown entry 'colour'"),
    "unknown material": (
        lambda f: build(f, material=material(model="neo")),
        "unknown material 'neo'",
    ),
    "negative mu": (lambda f: build(f, material=material(mu=-1)), "mu is -1.0"),
    "negative stiffness": (lambda f: build(f, stiffness=-5), "stiffness is -5"),
    "stiffness as text": (lambda f: build(f, stiffness="stiff"), "stiffness must be a number"),
    "no handles": (lambda f: build(f, handles=[]), "needs a fixed handle"),
    "same name": (lambda f: build(f, handles=handles("a", "a")), "the name 'a' is used twice"),
    "overlap": (lambda f: build(f, handles=overlapping()), "'left' and 'all' overlap"),
    "empty handle": (
        lambda f: build(f, handles=[*handles("a", "b"), {"name": "tail", "vertices": []}]),
        "handle 'tail': it has no vertices of the mesh, which reaches from (0, 0, 0) to (4, 1, 1)",
    ),
    "dimension over samples": (
        lambda f: build(f, "--samples", 20, "--dimension", 30),
        "dimension 30 needs at least as many samples, but there are 20; raise --samples",
    ),
    "default dimension over samples": (lambda f: build(f, "--samples", 20), "dimension 40 needs"),
    "dimension over the grid": (
        lambda f: build(f, "--samples", 63, "--dimension", 50, "--sampling", "grid"),
        "dimension 50 needs at least as many samples, but there are 32",
    ),
    "two sizes": (
        lambda f: build(f, "--dimension", 5, "--energy-fraction", 0.9),
        "give either --dimension or --energy-fraction",
    ),
    "energy fraction": (lambda f: build(f, "--energy-fraction", 1.5), "energy fraction is 1.5"),
    "tolerance": (lambda f: build(f, "--tolerance", 0), "tolerance is 0"),
    "tolerance nan": (lambda f: build(f, "--tolerance", "nan"), "tolerance is nan"),
    "clamp": (lambda f: build(f, "--solver", "newton", "--clamp", 2), "clamp is 2"),
    "projection without newton": (
        lambda f: build(f, "--projection", "clamp"),
        "--projection is for --solver newton; leave it out, or change the solver",
    ),
    "clamp without newton": (lambda f: build(f, "--clamp", 0.5), "--clamp is for --solver newton"),
    "clamp of another projection": (
        lambda f: build(f, "--solver", "newton", "--projection", "absolute", "--clamp", 0.5),
        "--clamp is for --projection stretches, not absolute",
    ),
    "clamp of the usual projection": (
        lambda f: build(
            f, "--solver", "newton", "--clamp", 0.5, material=material(model="stable-neo-hookean")
        ),
        "--clamp is for --projection stretches, not clamp, the default of this material; leave it",
    ),
    "settling with newton": (
        lambda f: build(f, "--solver", "newton", "--settling", 0.1),
        "--settling is for --solver fast",
    ),
    "settling": (
        lambda f: build(f, "--settling", 2),
        "'--settling': 2.0 is not in the range 0<=x<1",
    ),
    "edge length of tets": (
        lambda f: build(f, "--edge-length", 0.1),
        "--edge-length is for filling a surface with tets, but the mesh of the problem has tets",
    ),
    "edge length of given tets": (
        lambda f: build(f, f / "bar.msh", "--edge-length", 0.1),
        "bar.msh has tets already; leave it out",
    ),
    "samples": (
        lambda f: build(f, "--samples", 0),
        "'--samples': 0 is not in the range 1<=x<=1000000",
    ),
    "solver": (lambda f: build(f, "--solver", "magic"), "'--solver': 'magic' is not one of"),
    "output extension": (
        lambda f: [*build(f), "-o", f / "model.bin"],
        "model.bin: a model file ends in .snapspace",
    ),
    "output folder": (
        lambda f: [*build(f), "-o", f / "none" / "m.snapspace"],
        "none does not exist",
    ),
    "folder as output": (folder_as_output, "folder.snapspace: this is a folder"),
    "no output": (lambda f: build(f)[:3], "Missing option '-o'"),
    "not json": (not_json, "broken.json: not valid JSON"),
}


@pytest.mark.parametrize("name", BUILDS)
def test_build(run: Run, tmp_path: Path, name: str) -> None:
    case, message = BUILDS[name]
    words = case(tmp_path)
    (tmp_path / "new.snapspace").write_text("what was there before")
    before = contents(tmp_path)
    assert message in run(*words).error
    assert contents(tmp_path) == before


@pytest.mark.parametrize("name", BUILDS)
def test_json_leaves_standard_output_empty_too(run: Run, tmp_path: Path, name: str) -> None:
    case, message = BUILDS[name]
    assert message in run(*case(tmp_path), "--json").error


POSES: dict[str, tuple[list[str], str]] = {
    "unknown handle": (["--handle", "nose"], "no handle 'nose'; the handles are left, right"),
    "twice": (["--handle", "right", "--handle", "right"], "--handle right is given twice"),
    "no handle": (["--euler", "0,0,1"], "--euler belongs to the --handle before it"),
    "motion first": (["--translate", "0,0,1", "--handle", "right"], "--translate belongs to"),
    "two turns": (
        ["--handle", "right", "--euler", "0,0,1", "--translate", "0,0,1", "--euler", "0,0,2"],
        "--euler is given twice for handle 'right'",
    ),
    "two numbers": (["--handle", "right", "--euler", "0,30"], "'0,30' has 2 of three numbers"),
    "words": (["--handle", "right", "--euler", "a,b,c"], "'a,b,c' is not three numbers"),
    "nan": (["--handle", "right", "--translate", "0,nan,0"], "'0,nan,0' is not finite"),
    "infinite": (["--handle", "right", "--translate", "0,0,1e999"], "'0,0,1e999' is not finite"),
    "extension": (["-o", "out.xyz"], "out.xyz: unknown extension '.xyz'; known are .obj"),
    "folder": (["-o", "none/out.obj"], "none/out.obj: there is no folder none"),
    "picture": (["--png", "out.jpg"], "out.jpg: unknown extension '.jpg'; known are .png"),
    "dimension": (["--dimension", "11"], "--dimension is 11, but"),
    "usage": (["--angle", "3"], no_such_option("--angle")),
}


@pytest.mark.parametrize("name", POSES)
def test_pose(run: Run, model: Path, name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    words, message = POSES[name]
    monkeypatch.chdir(model.parent)
    for kept in ("good.obj", "good.png"):
        Path(kept).write_text("what was there before")
    outputs = [] if "-o" in words or "--png" in words else ["-o", "good.obj", "--png", "good.png"]
    before = contents(model.parent)
    assert message in run("pose", model, *words, *outputs).error
    assert contents(model.parent) == before


def truncated(data: bytes) -> bytes:
    return data[: len(data) // 2]


def cut_in_the_header(data: bytes) -> bytes:
    return data[:100]


def altered(data: bytes) -> bytes:
    changed = bytearray(data)
    changed[-9] ^= 1
    return bytes(changed)


def altered_header(data: bytes) -> bytes:
    assert b'\\"stiffness\\": 1000.0' in data
    return data.replace(b'\\"stiffness\\": 1000.0', b'\\"stiffness\\": 9000.0')


MODELS: dict[str, tuple[Callable[[bytes], bytes], str]] = {
    "truncated": (truncated, "not a complete snapspace model"),
    "cut in the header": (cut_in_the_header, "not a complete snapspace model"),
    "empty": (lambda data: b"", "not a complete snapspace model"),
    "something else": (lambda data: b"solid cube\n" * 50, "not a complete snapspace model"),
    "altered": (altered, "the checksum does not match"),
    "altered header": (altered_header, "the checksum does not match"),
}
TAKES_A_MODEL = (["info"], ["validate", "--samples", "2"], ["pose", "-o", "out.obj"])


@pytest.mark.parametrize("name", MODELS)
@pytest.mark.parametrize("command", TAKES_A_MODEL, ids=lambda words: words[0])
def test_model(
    run: Run, model: Path, name: str, command: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    change, message = MODELS[name]
    monkeypatch.chdir(model.parent)
    model.write_bytes(change(model.read_bytes()))
    before = contents(model.parent)
    error = run(*command, model.name, "--json").error
    assert error.startswith("bar.snapspace: ")
    assert message in error
    assert contents(model.parent) == before


@pytest.mark.parametrize("command", TAKES_A_MODEL, ids=lambda words: words[0])
def test_missing_model(run: Run, tmp_path: Path, command: list[str]) -> None:
    error = run(*command, tmp_path / "none.snapspace").error
    assert "none.snapspace: there is no such" in error


def test_info_of_an_unknown_kind(run: Run, tmp_path: Path) -> None:
    (tmp_path / "a.txt").write_text("hello")
    assert (
        "unknown extension '.txt'; known are .snapspace, .json"
        in run("info", tmp_path / "a.txt").error
    )


def test_info_of_a_mesh_beyond_repair(run: Run, tmp_path: Path) -> None:
    nan_in_the_mesh(tmp_path)
    assert "vertex 3 is not finite" in run("info", tmp_path / "nan.mesh").error


def test_demo(run: Run, tmp_path: Path) -> None:
    (tmp_path / "taken").write_text("a file")
    assert "taken: cannot create the folder" in run("demo", "--output", tmp_path / "taken").error
    output = tmp_path / "new"
    error = run("demo", "--output", output, "--samples", 5).error
    assert "dimension 40 needs at least as many samples" in error
    assert not output.exists()


def test_unknown_command(run: Run) -> None:
    assert "No such command 'bild'" in run("bild").error
