"""Worker: mutates and reads files for a while, in its own process; ends at the first fault."""

from __future__ import annotations

import faulthandler
import os
import sys
import time
from pathlib import Path
from random import Random

from .targets import TARGETS, FaultError, run

#: A reader that takes more processor seconds than this on one file hangs.
SECONDS = 5.0
#: So does one that has not returned after this time, whatever else the machine does.
WALL_SECONDS = 60.0
#: Bytes that reading one file may take beyond those in use before.
MEMORY = 1 << 30


def main(name: str, corpus: Path, folder: Path, seed: int, seconds: float, executions: int) -> int:
    """Prints the numbers of executions and of accepted files, and the reason of a fault, if any."""
    target, random = TARGETS[name], Random(seed)
    seeds = sorted((corpus / target.corpus).iterdir())
    contents = [seed.read_bytes() for seed in seeds]
    for path, data in zip(seeds, contents, strict=True):  # unchanged files must be accepted
        if not run(target, _written(folder, path, data)):
            print(f"0 0 the file {path.name} of the corpus is refused", flush=True)
            return 1
    _limit_memory()
    end, count, accepted = time.monotonic() + seconds, 0, 0
    while count < executions and time.monotonic() < end:
        at = random.randrange(len(seeds))
        data = target.mutated(contents[at], random, contents)
        path = _written(folder, seeds[at], data)
        faulthandler.dump_traceback_later(WALL_SECONDS, exit=True)
        begin = time.process_time()
        try:
            accepted += run(target, path)
            _check_time(time.process_time() - begin)
        except FaultError as fault:
            faulthandler.cancel_dump_traceback_later()
            print(f"{count + 1} {accepted} {' '.join(str(fault).split())[:600]}", flush=True)
            return 1
        faulthandler.cancel_dump_traceback_later()
        count += 1
        if count % 100 == 0:
            print(f"{count} {accepted}", flush=True)
    print(f"{count} {accepted}", flush=True)
    return 0


def _check_time(seconds: float) -> None:
    if seconds > SECONDS:
        raise FaultError(f"one file took {seconds:.1f} s of processor time")


def _written(folder: Path, seed: Path, data: bytes) -> Path:
    """Writes the only input of the folder; the other file of a pair stays as in the corpus."""
    for old in folder.iterdir():
        old.unlink()
    path = folder / f"input{seed.suffix}"
    path.write_bytes(data)
    if seed.suffix in (".node", ".ele"):  # a pair of files
        other = {".node": ".ele", ".ele": ".node"}[seed.suffix]
        (folder / f"input{other}").write_bytes(seed.with_suffix(other).read_bytes())
    return path


def _limit_memory() -> None:
    # the runtime of AddressSanitizer reserves terabytes of address space
    if sys.platform != "linux" or "libasan" in os.environ.get("LD_PRELOAD", ""):
        return
    import resource

    pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[0])
    limit = pages * resource.getpagesize() + MEMORY
    resource.setrlimit(resource.RLIMIT_AS, (limit, limit))


if __name__ == "__main__":
    name, corpus, folder, seed, seconds, most = sys.argv[1:]
    sys.exit(main(name, Path(corpus), Path(folder), int(seed), float(seconds), int(most)))
