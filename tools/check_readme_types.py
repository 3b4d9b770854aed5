"""Checks that the Python code of the README, read from top to bottom, passes `mypy --strict`."""

from __future__ import annotations

import re
import sys
import tempfile
from pathlib import Path

from mypy import api

ROOT = Path(__file__).parent.parent


def main() -> None:
    """Exits with code 1, and prints mypy's output, if a block fails after those before it."""
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    blocks = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "readme.py"
        file.write_text("\n".join(blocks), encoding="utf-8")
        options = ["--strict", "--allow-redefinition", "--no-error-summary"]
        out, err, code = api.run([*options, str(file)])
    sys.stderr.write(out + err)
    sys.exit(code != 0)


if __name__ == "__main__":
    main()
