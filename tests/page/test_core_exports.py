"""The page's record of the core's functions and structs agrees with the header."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

from .tools import ROOT, tool

maker = tool("make_core_exports")
build_wasm = tool("build_wasm")
header = maker.core_header


def test_the_file_is_of_the_present_header() -> None:
    written = maker.PATH.read_text(encoding="utf-8")
    assert written == maker.exports_text(), "run python tools/make_core_exports.py"


def test_all_functions_are_read_and_exported() -> None:
    names = {function.name for function in header.functions()}
    declared = set()
    for line in header.HEADER.read_text(encoding="utf-8").splitlines():
        if line[:1].isalpha() and "(" in line:
            declared.add(line.split("(")[0].split()[-1].lstrip("*"))
    assert names == declared and len(names) > 15
    assert names < set(build_wasm.EXPORTS)
    residual = next(f for f in header.functions() if f.name == "snapspace_residual")
    assert (residual.parameters, residual.returns) == (("session", "residual"), "int")


def test_enums_and_inner_structs() -> None:
    assert header.enums()["error"]["UNKNOWN_MATERIAL"] == -5
    assert list(header.enums()["status"].values()) == [0, 1, 2, 3, 4]
    cubature = next(struct for struct in header.structs() if struct.name == "cubature")
    assert [field.name for field in cubature.fields][-6:] == [
        "material_kind",
        "material_count",
        "material_moduli",
        "clusters_count",
        "clusters_sizes",
        "clusters_modes",
    ]


@pytest.mark.skipif(
    not build_wasm.has_compiler(), reason=f"needs ziglang {build_wasm.ZIGLANG}, which lays them out"
)
def test_structs_lie_in_memory_as_the_compiler_puts_them(tmp_path: Path) -> None:
    lines = ['#include "online/snapspace_online.h"', "#include <cstddef>"]
    for struct in header.structs():
        own = f"snapspace_{struct.name}"
        lines.append(f"static_assert(sizeof({own}) == {struct.size});")
        for field in struct.fields:
            inner = re.sub("^(material|clusters)_", r"\1.", field.name)
            lines.append(f"static_assert(offsetof({own}, {inner}) == {field.offset});")
    command = [sys.executable, "-m", "ziglang", "c++", "-target", "wasm32-wasi", "-std=c++20"]
    finished = subprocess.run(
        [*command, "-I", "core", "-x", "c++", "-c", "-", "-o", str(tmp_path / "empty.o")],
        input="\n".join(lines) + "\n",
        capture_output=True,
        text=True,
        cwd=ROOT,
        timeout=300,
    )
    assert finished.returncode == 0, finished.stderr
