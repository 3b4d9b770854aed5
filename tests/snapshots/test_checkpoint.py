"""Finished samples on disk: loaded again, and trusted only if complete and of the same run."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import nullcontext
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from safetensors.numpy import save_file

from snapspace import (
    Checkpoint,
    HandleBox,
    Handles,
    PosingProblem,
    Snapshots,
    SolverOptions,
    StVK,
    TetMesh,
    solve_snapshots,
)
from snapspace.snapshots import CheckpointNotice, run_key, solver_key

from .bars import assert_same_bits, parameters, posing_bar

FloatArray = NDArray[np.float64]
# Newton's blocks wait for each other, so they are saved one by one
OPTIONS = SolverOptions(solver="newton", block=4)


@pytest.fixture(scope="module")
def whole() -> Snapshots:
    """An uninterrupted run of three blocks."""
    problem = posing_bar()
    return solve_snapshots(problem, parameters(problem, 10), options=OPTIONS, threads=1)


def resume(whole: Snapshots, checkpoint: Checkpoint) -> Snapshots:
    return solve_snapshots(
        whole.problem, whole.parameters, options=OPTIONS, threads=1, checkpoint=checkpoint
    )


def keep(whole: Snapshots, checkpoint: Checkpoint, indices: list[int]) -> None:
    """Puts these samples of a run into a checkpoint, as the run would."""
    everything = Checkpoint(checkpoint.folder / "everything")
    resume(whole, everything)
    found = everything.load()
    displacements = np.array([found[i][0] for i in indices])
    checkpoint.save(indices, displacements, [found[i][1] for i in indices])


OTHER_RUNS: dict[str, Callable[[Snapshots], dict[str, Any]]] = {
    "other samples": lambda whole: {"parameters": parameters(whole.problem, 10, seed=8)},
    "fewer samples": lambda whole: {"parameters": whole.parameters[:6]},
    "other options": lambda whole: {"options": replace(OPTIONS, tolerance=1e-3)},
    "another material": lambda whole: {"problem": posing_bar(material=StVK(mu=2.0))},
    "another mesh": lambda whole: {"problem": posing_bar(6)},
}


@pytest.mark.parametrize("change", OTHER_RUNS.values(), ids=OTHER_RUNS)
def test_samples_of_another_run_are_not_taken_for_those_of_this_one(
    whole: Snapshots, tmp_path: Path, change: Callable[[Snapshots], dict[str, Any]]
) -> None:
    """Their shapes would be solutions for other parameters, and look converged."""
    checkpoint = Checkpoint(tmp_path / "run")
    assert_same_bits(resume(whole, checkpoint), whole)
    run = {"problem": whole.problem, "parameters": whole.parameters, "options": OPTIONS}
    changed = {**run, **change(whole)}
    with pytest.raises(ValueError, match="run: these samples are of another run: the pro") as told:
        solve_snapshots(**changed, checkpoint=checkpoint)
    assert "delete this one with Checkpoint.remove()" in str(told.value)
    assert_same_bits(resume(whole, checkpoint), whole)
    checkpoint.remove()
    fresh = solve_snapshots(**changed, checkpoint=checkpoint, threads=1)
    assert_same_bits(fresh, solve_snapshots(**changed, threads=1))


def test_every_block_is_saved(whole: Snapshots, tmp_path: Path) -> None:
    checkpoint = Checkpoint(tmp_path / "run")
    assert checkpoint.load() == {}
    assert_same_bits(resume(whole, checkpoint), whole)
    found = checkpoint.load()
    assert sorted(found) == list(range(10))
    assert len(list(checkpoint.folder.iterdir())) == 3
    rest = whole.problem.mesh.vertices.reshape(-1)
    for index, (displacement, report) in found.items():
        np.testing.assert_array_equal(displacement + rest, whole.shapes[index])
        assert report.iterations == whole.reports[index].iterations
    checkpoint.remove()
    assert not checkpoint.folder.exists()
    checkpoint.remove()


def test_a_full_checkpoint_leaves_nothing_to_solve(whole: Snapshots, tmp_path: Path) -> None:
    checkpoint = Checkpoint(tmp_path)
    first = resume(whole, checkpoint)
    again = resume(whole, checkpoint)
    np.testing.assert_array_equal(again.shapes, first.shapes)
    assert again.reports == first.reports  # also the same seconds


@pytest.mark.parametrize("indices", [[0, 2], [3], [0, 1, 2, 3, 5], [*range(8), 9]])
def test_any_finished_samples_lead_to_the_same_end(
    whole: Snapshots, tmp_path: Path, indices: list[int]
) -> None:
    """Ctrl-C may leave any part of a block; starts come only from the blocks before it."""
    checkpoint = Checkpoint(tmp_path)
    keep(whole, checkpoint, indices)
    assert sorted(checkpoint.load()) == indices
    assert_same_bits(resume(whole, checkpoint), whole)


def truncate(path: Path) -> None:
    path.write_bytes(path.read_bytes()[:-100])


def empty(path: Path) -> None:
    path.write_bytes(b"")


def junk(path: Path) -> None:
    path.write_bytes(np.random.default_rng(0).bytes(5000))


def text(path: Path) -> None:
    path.write_text("not what it was\n" * 100, encoding="utf-8")


def other_arrays(path: Path) -> None:
    save_file({"weights": np.zeros(3)}, path)


def no_arrays(path: Path) -> None:
    save_file({"weights": np.zeros(3)}, path, {"reports": "[]"})


def broken_reports(path: Path) -> None:
    save_file(
        {"indices": np.array([0]), "shapes": np.zeros((1, 243))}, path, {"reports": '[{"a": 1}]'}
    )


def too_few_reports(path: Path) -> None:
    save_file({"indices": np.array([0]), "shapes": np.zeros((1, 243))}, path, {"reports": "[]"})


def one_bit(path: Path) -> None:
    content = bytearray(path.read_bytes())
    content[-5] ^= 4
    path.write_bytes(content)


def folder(path: Path) -> None:
    path.unlink()
    path.mkdir()


@pytest.mark.parametrize(
    "spoil",
    [
        truncate,
        empty,
        junk,
        text,
        one_bit,
        other_arrays,
        no_arrays,
        broken_reports,
        too_few_reports,
        folder,
    ],
)
def test_a_spoilt_file_is_ignored_and_its_samples_are_solved_again(
    whole: Snapshots, tmp_path: Path, spoil: Callable[[Path], None]
) -> None:
    checkpoint = Checkpoint(tmp_path / "run")
    resume(whole, checkpoint)
    files = sorted(checkpoint.folder.iterdir())
    spoil(files[1])
    notice = r"samples-00004-4\.safetensors: not used \(.+\); its samples are solved again"
    with pytest.warns(CheckpointNotice, match=notice):
        assert sorted(checkpoint.load()) == [0, 1, 2, 3, 8, 9]
    if spoil is folder:
        files[1].rmdir()
    with nullcontext() if spoil is folder else pytest.warns(CheckpointNotice, match=notice):
        resumed = resume(whole, checkpoint)
    assert_same_bits(resumed, whole)
    assert sorted(checkpoint.load()) == list(range(10))


def test_other_files_in_the_folder_are_ignored(whole: Snapshots, tmp_path: Path) -> None:
    (tmp_path / "notes.txt").write_text("mine", encoding="utf-8")
    (tmp_path / ".samples-00000-4.1234.safetensors").write_bytes(b"half a file")
    assert_same_bits(resume(whole, Checkpoint(tmp_path)), whole)
    assert (tmp_path / "notes.txt").read_text(encoding="utf-8") == "mine"


def test_a_folder_that_cannot_be_made_is_named(whole: Snapshots, tmp_path: Path) -> None:
    (tmp_path / "file").write_text("", encoding="utf-8")
    with pytest.warns(
        CheckpointNotice, match=r"file/run: \d+ finished samples, .* are not saved: "
    ):
        assert_same_bits(resume(whole, Checkpoint(tmp_path / "file" / "run")), whole)


def test_the_folder_is_beside_the_output() -> None:
    checkpoint = Checkpoint.beside(Path("models/dragon.snapspace"), "0123abcd")
    assert checkpoint.folder == Path("models/dragon.snapspace.partial-0123abcd")


BASE: dict[str, Any] = {
    "vertices": posing_bar().mesh.vertices,
    "handles": posing_bar().handles,
    "material": StVK(lam=1.0, mu=1.0),
    "stiffness": 1000.0,
    "domain": HandleBox(translation=0.25, angle=0.25),
    "samples": parameters(posing_bar(), 5),
    "options": SolverOptions(),
}


def key(**changes: Any) -> str:
    run = {**BASE, **changes}
    problem = PosingProblem(
        TetMesh(run["vertices"], posing_bar().mesh.tets),
        run["handles"],
        material=run["material"],
        stiffness=run["stiffness"],
        domain=run["domain"],
    )
    return run_key(problem, run["samples"], solver_key(run["options"], problem))


def test_the_key_is_the_same_for_the_same_run() -> None:
    assert key() == key()
    assert len(key()) == 16 and int(key(), 16) >= 0
    spelt_out = SolverOptions(
        solver="fast", tolerance=1e-6, settling=1e-2, precision="single", block=16
    )
    assert key(options=spelt_out) == key()


def moved_vertex() -> FloatArray:
    vertices = BASE["vertices"].copy()
    vertices[40, 0] = np.nextafter(vertices[40, 0], 9.0)
    return np.asarray(vertices)


def nudged_sample() -> FloatArray:
    samples = BASE["samples"].copy()
    samples[4, 5] = np.nextafter(samples[4, 5], 9.0)
    return np.asarray(samples)


@pytest.mark.parametrize(
    "change",
    [
        {"vertices": moved_vertex()},
        {"handles": Handles([BASE["handles"][0].vertices, BASE["handles"][1].vertices[1:]])},
        {"handles": Handles([BASE["handles"][1].vertices, BASE["handles"][0].vertices])},
        {"material": StVK(lam=1.0, mu=1.0 + 1e-12)},
        {"material": StVK(lam=0.9, mu=1.0)},
        {"stiffness": 1000.5},
        {"domain": HandleBox(translation=0.25, angle=0.2)},
        {"samples": nudged_sample()},
        {"samples": BASE["samples"][:4]},
        {"samples": BASE["samples"][::-1]},
        {"options": SolverOptions(solver="newton")},
        {"options": SolverOptions(tolerance=2e-5)},
        {"options": SolverOptions(max_iterations=999)},
        {"options": SolverOptions(clamp=0.7)},
        {"options": SolverOptions(precision="double")},
        {"options": SolverOptions(block=32)},
        {"options": SolverOptions(soft_modes=False, settling=1e-2)},
    ],
    ids=lambda change: next(iter(change)),
)
def test_the_key_depends_on_all_that_matters(change: dict[str, Any]) -> None:
    assert key(**change) != key()


def test_the_key_does_not_depend_on_threads() -> None:
    entries = set(solver_key(SolverOptions(), posing_bar()))
    assert "threads" not in entries
    assert entries == {"single"} | set(asdict(SolverOptions())) - {"precision"}
