"""core/online compiled on its own, as for a C program, and called through ctypes."""

from __future__ import annotations

import ctypes
import os
import shlex
import shutil
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

CORE = Path(__file__).parents[2] / "core"
UNIT = "".join(
    f'#include "online/{path.name}"\n' for path in sorted((CORE / "online").glob("*.cpp"))
)

#: Counts the library's heap allocations.
COUNTER = """
#include <cstdlib>
#include <new>
static long count = 0;
extern "C" long allocations() { return count; }
void* operator new(std::size_t size) { ++count; return std::malloc(size); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  ++count;
  const auto unit = static_cast<std::size_t>(alignment);
  return std::aligned_alloc(unit, (size + unit - 1) / unit * unit);
}
void operator delete(void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
void operator delete(void* p, std::align_val_t) noexcept { std::free(p); }
void operator delete(void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }
"""


def compiler() -> list[str]:
    """The C++ compiler that CXX or the system names; the test is skipped without one."""
    if wanted := os.environ.get("CXX"):
        return shlex.split(wanted)
    for candidate in ("c++", "g++", "clang++"):
        if shutil.which(candidate):
            return [candidate]
    pytest.skip("needs a C++ compiler (CXX, c++, g++ or clang++)")


def run(command: list[str], source: str) -> None:
    finished = subprocess.run(command, input=source, capture_output=True, text=True, timeout=300)
    assert finished.returncode == 0, finished.stderr


def compiled(folder: Path) -> ctypes.CDLL:
    """All of core/online as one translation unit without exceptions and run-time types."""
    target = folder / "online.so"
    options = ["-std=c++20", "-O0", "-Wall", "-Wextra", "-fno-exceptions", "-fno-rtti"]
    linked = ["-shared", "-fPIC", "-Wl,-Bsymbolic", f"-I{CORE}", "-x", "c++", "-"]
    run([*compiler(), *options, *linked, "-o", str(target)], UNIT + COUNTER)
    library = ctypes.CDLL(str(target))
    library.allocations.restype = ctypes.c_long
    library.snapspace_create_posing.restype = ctypes.c_void_p
    library.snapspace_create_posing_cubature.restype = ctypes.c_void_p
    library.snapspace_create_blending.restype = ctypes.c_void_p
    library.snapspace_create_blending_cubature.restype = ctypes.c_void_p
    library.snapspace_create_blending_stars.restype = ctypes.c_void_p
    library.snapspace_modulus_name.restype = ctypes.c_char_p
    return library


class Basis(ctypes.Structure):
    _fields_ = (
        ("vertices", ctypes.c_int),
        ("tau", ctypes.c_void_p),
        ("modes", ctypes.c_void_p),
    )


class Material(ctypes.Structure):
    _fields_ = (
        ("kind", ctypes.c_char_p),
        ("count", ctypes.c_int),
        ("moduli", ctypes.c_void_p),
    )


class Clusters(ctypes.Structure):
    _fields_ = (
        ("count", ctypes.c_int),
        ("sizes", ctypes.c_void_p),
        ("modes", ctypes.c_void_p),
    )


class Cubature(ctypes.Structure):
    _fields_ = (
        ("tets", ctypes.c_int),
        ("rows", ctypes.c_void_p),
        ("weights", ctypes.c_void_p),
        ("material", Material),
        ("clusters", Clusters),
    )


class Stars(ctypes.Structure):
    _fields_ = (
        ("poses", ctypes.c_int),
        ("stars", ctypes.c_int),
        ("rows", ctypes.c_void_p),
        ("weights", ctypes.c_void_p),
        ("material", Material),
        ("origins", ctypes.c_void_p),
        ("forms", ctypes.c_void_p),
    )


class Probe(ctypes.Structure):
    _fields_ = (
        ("corners", ctypes.c_int),
        ("tets", ctypes.c_int),
        ("rests", ctypes.c_int),
        ("samples", ctypes.c_int),
        ("pins", ctypes.c_int),
        ("tau", ctypes.c_void_p),
        ("modes", ctypes.c_void_p),
        ("rest_shapes", ctypes.c_void_p),
        ("tet_corners", ctypes.c_void_p),
        ("material", Material),
        ("sampled", ctypes.c_void_p),
        ("weights", ctypes.c_void_p),
        ("pinned", ctypes.c_void_p),
        ("pin_handles", ctypes.c_void_p),
        ("pulls", ctypes.c_void_p),
        ("arms", ctypes.c_void_p),
    )


class StarProbe(ctypes.Structure):
    _fields_ = (
        ("stars", ctypes.c_int),
        ("rests", ctypes.c_int),
        ("samples", ctypes.c_int),
        ("parts", ctypes.c_int),
        ("pins", ctypes.c_int),
        ("origins", ctypes.c_void_p),
        ("modes", ctypes.c_void_p),
        ("material", Material),
        ("part_stars", ctypes.c_void_p),
        ("part_samples", ctypes.c_void_p),
        ("part_vectors", ctypes.c_void_p),
        ("weights", ctypes.c_void_p),
        ("pinned", ctypes.c_void_p),
        ("pin_handles", ctypes.c_void_p),
        ("pulls", ctypes.c_void_p),
        ("arms", ctypes.c_void_p),
    )


class Options(ctypes.Structure):
    _fields_ = (
        ("method", ctypes.c_int),
        ("tolerance", ctypes.c_double),
        ("value_scale", ctypes.c_double),
        ("coordinate_scale", ctypes.c_double),
        ("max_iterations", ctypes.c_int),
        ("max_evaluations", ctypes.c_int),
    )


class Report(ctypes.Structure):
    _fields_ = (
        ("status", ctypes.c_int),
        ("iterations", ctypes.c_int),
        ("evaluations", ctypes.c_int),
        ("value", ctypes.c_double),
        ("gradient_norm", ctypes.c_double),
    )


def address(array: NDArray[Any]) -> ctypes.c_void_p:
    assert array.dtype in (np.float64, np.float32, np.int32) and array.flags.c_contiguous
    return ctypes.c_void_p(array.ctypes.data)
