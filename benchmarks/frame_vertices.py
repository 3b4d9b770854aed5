"""The part `vertices` of benchmarks/online.py: tau + U q against the memory's read rate."""

from __future__ import annotations

import argparse
from typing import Any

import common
import numpy as np

from snapspace import _core as core

Rows = list[tuple[str, Any, str]]


def vertices(args: argparse.Namespace) -> tuple[dict[str, Any], Rows]:
    """tau + U q for 32k vertices, in double and for the screen; bound: one thread reading U."""
    rng = np.random.default_rng(args.seed)
    n, d = 32_000, args.dimension
    tau, modes = rng.normal(size=3 * n), rng.normal(size=(d, 3 * n))
    q = rng.normal(size=d) / np.arange(1, d + 1)  # decreasing like coordinates of a PCA
    bound = modes.nbytes / core.read_bandwidth(modes.nbytes)
    compiled = core.time_reconstruct(tau, modes, q)
    called = common.best_of(30, lambda: core.reconstruct(tau, modes, q))
    peer = common.best_of(30, lambda: tau + q @ modes)
    screen = core.ShapeRows(tau, modes)
    screen_bound = screen.bytes / core.read_bandwidth(screen.bytes)
    shown = [
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
        "screen_bound": screen_bound,
        "screen_one_thread": shown[0],
        "screen": shown[1],
        "screen_off": float(off),
    }
    rows: Rows = [
        ("reading U once, ms", 1e3 * bound, f"{modes.nbytes / 1e6:.0f} MB"),
        ("tau + U q, ms", 1e3 * compiled, ""),
        ("share of the read rate", bound / compiled, ">= 0.6"),
        ("into a new NumPy array, ms", 1e3 * called, ""),
        ("NumPy, ms", 1e3 * peer, ""),
        ("for the screen: reading once, ms", 1e3 * screen_bound, f"{screen.bytes / 1e6:.0f} MB"),
        ("for the screen, one thread, ms", 1e3 * shown[0], ""),
        ("for the screen, ms", 1e3 * shown[1], "<= 0.6"),
        ("share of the read rate", screen_bound / shown[1], ""),
        ("error, share of the displacement", float(off), "<= 2e-5"),
    ]
    return result, rows
