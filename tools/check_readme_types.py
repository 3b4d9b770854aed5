"""Checks that the Python code of the README passes `mypy --strict`."""

from __future__ import annotations

import re
import sys
import tempfile
from pathlib import Path

from mypy import api

ROOT = Path(__file__).parent.parent
#: Names that blocks take from the text around them.
GIVEN = """
import numpy as np
import snapspace as ss
def posed() -> ss.PosingModel: ...
def blended() -> ss.InterpolationProblem: ...
"""
#: For blocks that begin with a key: definitions of names from earlier blocks.
BEFORE = {
    "back": "session = posed().session()",
    "samples": "problem = blended()",
    "# once": "model = posed()",
}


def main() -> None:
    """Exits with code 1, and prints mypy's output, if a block is not well typed."""
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    failed = False
    with tempfile.TemporaryDirectory() as folder:
        for number, block in enumerate(re.findall(r"```python\n(.*?)```", text, re.DOTALL)):
            before = next((given for start, given in BEFORE.items() if block.startswith(start)), "")
            file = Path(folder) / f"readme_{number}.py"
            file.write_text(f"{GIVEN}\n{before}\n{block}", encoding="utf-8")
            options = ["--strict", "--disable-error-code=empty-body", "--no-error-summary"]
            out, err, code = api.run([*options, str(file)])
            failed = failed or code != 0
            sys.stderr.write(out + err)
    sys.exit(failed)


if __name__ == "__main__":
    main()
