"""Steps in time against static frames, on default models.

    python benchmarks/time_steps.py
    python benchmarks/time_steps.py --problem dragon --model dragon.snapspace

A handle is pulled to and fro; every step is timed without the vertices. "Root" steps also move the
first handle. Energies are those after a pulled handle is let go, undamped: the largest growth from
one step to the next, relative to the first one, over steps of 1/15 to 1/240 s.
"""

from __future__ import annotations

import argparse
import json
import time
from typing import Any

import common
import numpy as np
import problems

import snapspace as ss

STEPS = 300


def timed(session: ss.PosingSession, names: tuple[str, ...], how: str) -> float:
    """Milliseconds, the median of many frames."""
    half = session.model.problem.domain.half_widths[:3]
    session.reset()
    taken = []
    for k in range(STEPS):
        shift = 0.5 * np.sin(k / 10.0) * half
        target = {names[-1]: ((0.0, 0.0, 0.0), shift)}
        if how == "root":
            target |= {name: ((0.0, 0.0, 0.0), shift) for name in names[:-1]}
        begin = time.perf_counter()
        if how == "static":
            session.move_all(target)
        else:
            session.step(1 / 60, target)
        taken.append(time.perf_counter() - begin)
    return 1e3 * float(np.median(taken[10:]))


def growth(session: ss.PosingSession) -> float:
    """Largest growth of the energy in a step, relative to the first energy."""
    most = -np.inf
    session.dynamics = ss.Dynamics(damping=0.0)
    for dt in (1 / 240, 1 / 60, 1 / 15):
        session.reset()
        session.pose(0.8 * session.model.problem.domain.half_widths)
        rest = {name: ((0, 0, 0), (0, 0, 0)) for name in session.model.problem.handles.names}
        session.step(dt, rest)
        energies = [session.mechanical_energy]
        for _ in range(100):
            session.step(dt)
            energies.append(session.mechanical_energy)
        most = max(most, float(np.diff(energies).max()) / energies[0])
    session.dynamics = ss.Dynamics()
    return most


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument(
        "--problem", nargs="+", default=["dragon", "creature"], metavar="NAME", help=problems.HELP
    )
    parser.add_argument("--model", help="model file of the first problem, not a new default build")
    parser.add_argument("--json", action="store_true")
    args = parser.parse_args()
    rows: list[dict[str, Any]] = []
    for number, name in enumerate(args.problem):
        if args.model and number == 0:
            model = ss.load_posing(args.model)
        else:
            body = common.with_material(problems.read(name), "stable-neo-hookean")
            model = ss.accurate_model(body).model
        session, names = model.session(), model.problem.handles.names
        times = {f"{how} ms": timed(session, names, how) for how in ("static", "step", "root")}
        rows.append({"problem": name, "d": model.dimension, **times, "growth": growth(session)})
        if args.json:
            print(json.dumps(rows[-1]), flush=True)
    if args.json:
        return
    common.print_rows(rows, title="steps of 1/60 s against static frames", width=120)


if __name__ == "__main__":
    main()
