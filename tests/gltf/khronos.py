"""faults_of: what the Khronos validator finds in .glb files."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from ..page.tools import ROOT, tool

VALIDATE = """
import { readFileSync } from "node:fs";
import validator from "gltf-validator";
const found = [];
for (const file of process.argv.slice(2)) {
  const report = await validator.validateBytes(new Uint8Array(readFileSync(file)));
  found.push(...report.issues.messages.filter(({ severity }) => severity < 2));
}
console.log(JSON.stringify(found));
"""


def faults_of(*files: Path) -> list[dict[str, Any]]:
    """Errors and warnings of all files."""
    script = ROOT / "web" / "node_modules" / ".validate.mjs"
    script.write_text(VALIDATE, encoding="utf-8")
    finished = tool("node").run([script, *files])
    script.unlink()
    assert finished.returncode == 0, finished.stderr
    found: list[dict[str, Any]] = json.loads(finished.stdout)
    return found
