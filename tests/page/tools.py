"""The scripts of tools/, as modules."""

from __future__ import annotations

import importlib.util
import re
import sys
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[2]


def tool(name: str) -> Any:
    """tools/NAME.py, loaded once."""
    module = f"snapspace_tools_{name}"
    if module not in sys.modules:
        spec = importlib.util.spec_from_file_location(module, ROOT / "tools" / f"{name}.py")
        assert spec is not None and spec.loader is not None
        sys.modules[module] = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(sys.modules[module])
    return sys.modules[module]


def assert_node_tests_pass(folder: str, **env: str) -> None:
    """Runs web/FOLDER/tests under node, all files in one process."""
    files = sorted((ROOT / "web" / folder / "tests").glob("*.test.ts"))
    options = ["--test", "--test-isolation=none", "--test-reporter=spec"]
    finished = tool("node").run([*options, *files], env=env)
    assert finished.returncode == 0, finished.stdout + finished.stderr
    passed = re.search(r"pass (\d+)", finished.stdout)
    assert passed and int(passed[1]) >= len(files) > 0, finished.stdout
