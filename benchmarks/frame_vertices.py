"""The part `vertices` of benchmarks/online.py: tau + U q against what the memory delivers."""

from __future__ import annotations

import argparse
from typing import Any

import common
import numpy as np

from snapspace import _core as core

Rows = list[tuple[str, Any, str]]


def vertices(args: argparse.Namespace) -> tuple[dict[str, Any], Rows]:
    """tau + U q for 32k vertices, in double and for the screen; bound: one thread reads U once."""
    rng = np.random.default_rng(args.seed)
    n, d = 32_000, args.dimension
    tau, modes, q = rng.normal(size=3 * n), rng.normal(size=(d, 3 * n)), rng.normal(size=d)
    bound = modes.nbytes / core.read_bandwidth(modes.nbytes)
    compiled = core.time_reconstruct(tau, modes, q)
    called = common.best_of(30, lambda: core.reconstruct(tau, modes, q))
    peer = common.best_of(30, lambda: tau + q @ modes)
    screen = core.ShapeRows(tau, modes)
    single_bound = screen.bytes / core.read_bandwidth(screen.bytes)
    single = [
        common.best_of(30, lambda threads=threads: screen.shape(q, threads=threads))
        for threads in (1, 0)
    ]
    displacement = q @ modes
    off = np.abs(screen.shape(q) - (tau + displacement)).max() / np.abs(displacement).max()
    result = {
        "bound": bound,
        "compiled": compiled,
        "called": called,
        "numpy": peer,
        "single_bound": single_bound,
        "single_one_thread": single[0],
        "single": single[1],
        "single_off": float(off),
    }
    rows: Rows = [
        ("reading U once, ms", 1e3 * bound, f"{modes.nbytes / 1e6:.0f} MB"),
        ("tau + U q, ms", 1e3 * compiled, ""),
        ("share of the read rate", bound / compiled, ">= 0.6"),
        ("into a new NumPy array, ms", 1e3 * called, ""),
        ("NumPy, ms", 1e3 * peer, ""),
        ("single precision: reading once, ms", 1e3 * single_bound, f"{screen.bytes / 1e6:.0f} MB"),
        ("single precision, one thread, ms", 1e3 * single[0], ""),
        ("share of the read rate", single_bound / single[0], ">= 0.8"),
        ("single precision, ms", 1e3 * single[1], "<= 0.6"),
        ("off, share of the displacement", float(off), "<= 1e-6"),
    ]
    return result, rows
