"""Runs the fuzzers, which share the given time, and prints how many files each has read."""

from __future__ import annotations

import argparse
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from .corpus import write_corpus
from .targets import TARGETS

ROOT = Path(__file__).parent.parent
FAILURES = ROOT / "build" / "fuzz" / "failures"


def main() -> int:
    parser = argparse.ArgumentParser(prog="python -m fuzz", description=__doc__)
    parser.add_argument(
        "targets", nargs="*", metavar="TARGET", help=f"any of {', '.join(TARGETS)} (default: all)"
    )
    parser.add_argument(
        "--seconds", type=float, default=120.0, help="time of all fuzzers together (default: 120)"
    )
    parser.add_argument(
        "--executions",
        type=int,
        default=10**9,
        help="largest number of files per target; the files are the same in every run",
    )
    parser.add_argument("--seed", type=int, default=0, help="seed of the mutations (default: 0)")
    options = parser.parse_args()
    names = options.targets or list(TARGETS)
    unknown = [name for name in names if name not in TARGETS]
    if unknown:
        parser.error(f"unknown target {unknown[0]!r}; known are {', '.join(TARGETS)}")
    with tempfile.TemporaryDirectory() as temporary:
        corpus = Path(temporary) / "corpus"
        write_corpus(corpus)
        share = options.seconds / len(names)
        faults = [fuzz(name, corpus, options.seed, share, options.executions) for name in names]
    return 1 if any(faults) else 0


def fuzz(name: str, corpus: Path, seed: int, seconds: float, executions: int) -> bool:
    """Whether a reader has a fault; prints executions and, if so, the fault."""
    folder = corpus.parent / name
    folder.mkdir()
    bounds = [seed, seconds, executions]
    command = [sys.executable, "-m", "fuzz.worker", name, corpus, folder, *bounds]
    finished = subprocess.run(
        list(map(str, command)), cwd=ROOT, capture_output=True, text=True, encoding="utf-8"
    )
    lines = finished.stdout.splitlines() or ["0 0"]
    count, accepted, reason = [*lines[-1].split(" ", 2), ""][:3]
    about = f"{name}: {count} executions, {accepted} files accepted"
    if finished.returncode == 0:
        print(f"{about}, no fault", flush=True)
        return False
    for path in folder.glob("input.*"):
        FAILURES.mkdir(parents=True, exist_ok=True)
        kept = FAILURES / f"{name}{path.suffix}"
        shutil.copyfile(path, kept)
        print(f"  kept: {kept.relative_to(ROOT)}")
    reason = reason or f"it hung or crashed (exit code {finished.returncode})"
    print(f"{about}, FAULT: {reason}\n{finished.stderr[-3000:]}", flush=True)
    return True


if __name__ == "__main__":
    sys.exit(main())
