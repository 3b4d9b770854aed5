"""The core's include graph; `make lint` compiles core/online alone."""

from __future__ import annotations

import re
from pathlib import Path

CORE = Path(__file__).parents[2] / "core"

#: Packages of the core that each package's files may include, besides their own.
ALLOWED: dict[str, set[str]] = {
    "dense": set(),
    "element": set(),
    "material": {"element", "simd"},
    "memory": set(),
    "mesh": {"element", "memory", "threads"},
    "simd": set(),
    "threads": set(),
    "online": {"element", "material", "simd"},
    "energy": {"element", "material", "memory", "mesh", "simd", "threads"},
    "cholesky": {"memory", "simd"},
    "multigrid": {"cholesky", "dense", "memory", "simd"},
    "patches": {"energy", "material", "mesh", "online"},
    "snapshots": {
        "cholesky",
        "dense",
        "element",
        "energy",
        "memory",
        "mesh",
        "multigrid",
        "online",
        "patches",
        "simd",
        "threads",
    },
    "reduction": {"element", "energy", "material", "memory", "mesh", "online", "simd", "threads"},
    "polish": {"simd", "snapshots", "threads"},
    "fitting": {"cholesky", "element", "energy", "mesh", "snapshots", "threads"},
    "lanes": {"cholesky", "energy", "memory", "multigrid", "simd", "threads"},
    "live": {"material", "online", "threads"},
    "measure": {"energy", "live", "mesh", "simd", "snapshots", "threads"},
    "bindings": {
        "lanes",
        "live",
        "measure",
        "cholesky",
        "element",
        "material",
        "multigrid",
        "mesh",
        "energy",
        "snapshots",
        "polish",
        "fitting",
        "reduction",
        "online",
        "simd",
        "threads",
    },
}

#: core/online is meant for WebAssembly too: no threads, files, output, exceptions, Eigen.
ONLINE_MAY_INCLUDE = {
    "algorithm", "array", "bit", "cmath", "cstddef", "cstdint", "cstring", "immintrin.h",
    "limits", "memory",
    "numeric", "span", "type_traits", "utility", "vector",
}  # fmt: skip


def sources(folder: Path) -> list[Path]:
    return sorted([*folder.rglob("*.h"), *folder.rglob("*.cpp")])


def name(path: Path) -> str:
    return path.relative_to(CORE).as_posix()


def included(path: Path, pattern: str) -> list[str]:
    return re.findall(rf"^\s*#\s*include\s+{pattern}", path.read_text(encoding="utf-8"), re.M)


def code(path: Path) -> str:
    """A file's text without comments and strings."""
    text = path.read_text(encoding="utf-8")
    return re.sub(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"', " ", text, flags=re.S)


def test_includes_point_one_way() -> None:
    for path in sources(CORE):
        own = path.relative_to(CORE).parts[0]
        for target in included(path, r'"([^"]+)"'):
            assert (CORE / target).is_file(), f"{name(path)}: {target} is not in core"
            package = target.split("/")[0]
            assert package == own or package in ALLOWED[own], f"{name(path)} includes {target}"


def test_every_package_is_in_the_table() -> None:
    assert {path.relative_to(CORE).parts[0] for path in sources(CORE)} == set(ALLOWED)


def test_online_needs_numbers_and_memory_only() -> None:
    for path in sources(CORE / "online") + sources(CORE / "simd"):
        assert set(included(path, r"<([^>]+)>")) <= ONLINE_MAY_INCLUDE, name(path)
        for word in ("throw", "try", "catch", "thread_local", "std::cout", "printf", "fopen"):
            assert not re.search(rf"\b{re.escape(word)}\b", code(path)), f"{name(path)}: {word}"


def test_headers_are_guarded_and_nothing_prints() -> None:
    for path in sources(CORE):
        if path.suffix == ".h":
            assert "#pragma once" in path.read_text(encoding="utf-8"), name(path)
        system = set(included(path, r"<([^>]+)>"))
        assert not system & {"iostream", "fstream", "cstdio", "omp.h"}, name(path)
