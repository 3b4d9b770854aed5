"""The fuzzers find what they look for, and every test run tries a few of their files."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from random import Random

import pytest

from fuzz.corpus import write_corpus
from fuzz.targets import TARGETS, FaultError, Target, run

PYTHON = [name for name in TARGETS if not name.startswith("page")]


@pytest.fixture(scope="module")
def corpus(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("corpus")
    write_corpus(folder)
    return folder


@pytest.mark.filterwarnings("ignore")  # meshio warns of text and of tags that it adds
@pytest.mark.parametrize("name", PYTHON)
def test_readers_take_or_refuse_mutated_files(name: str, corpus: Path, tmp_path: Path) -> None:
    target, random, taken = TARGETS[name], Random(7), []
    seeds = sorted((corpus / target.corpus).iterdir())
    contents = [seed.read_bytes() for seed in seeds]
    assert all(run(target, seed) for seed in seeds)
    for _ in range(40):
        at = random.randrange(len(seeds))
        path = tmp_path / f"input{seeds[at].suffix}"
        path.write_bytes(target.mutated(contents[at], random, contents))
        taken.append(run(target, path))
    assert not all(taken)


def _failing(error: BaseException) -> Callable[[Path], None]:
    def read(path: Path) -> None:
        raise error

    return read


@pytest.mark.parametrize(
    "error",
    [KeyError("x"), MemoryError(), SystemExit(1), ValueError("two\nlines"), ValueError(""),
     ValueError("x" * 2000), UnicodeDecodeError("utf-8", b"x", 0, 1, "bad")],
)  # fmt: skip
def test_anything_but_a_refusal_in_one_line_is_a_fault(error: BaseException) -> None:
    with pytest.raises(FaultError):
        run(Target("model", _failing(error)), Path())
    assert not run(Target("model", _failing(ValueError("bad.obj: it has no faces"))), Path())
