"""The summary that `build`, `interpolate` and `demo` print at the end."""

from __future__ import annotations

import numpy as np

from ..problem import PosingProblem, handle_misses, usual_stiffness
from .accuracy_facts import accuracy_facts
from .console import notice, print_facts
from .model_info import energy_text
from .pipeline import Built
from .units import in_bytes, in_percent, in_time

#: Largest median distance of samples from their handles' targets, as a share of the motion.
MISSED = 0.01


def print_summary(built: Built, *, include_unconverged: bool) -> None:
    """Prints what was built on standard error."""
    figures = built.as_json()
    snapshots = figures["snapshots"]
    left_out = len(built.snapshots) - snapshots["converged"]
    cells = next(f"{figures[name]} {name}" for name in ("tets", "triangles") if name in figures)
    facts = [
        ("mesh", f"{figures['vertices']} vertices, {cells}"),
        ("samples", built.snapshots.summary()),
    ]
    if left_out:
        what = "used anyway" if include_unconverged else "left out of the basis"
        facts.append(("", f"{left_out} unconverged, {what}"))
    seconds = ", ".join(f"{name} {in_time(value)}" for name, value in built.seconds.items())
    facts += [
        (
            "subspace",
            f"dimension {figures['dimension']}, holds {_percent(figures['energy_fraction'])} of "
            "the snapshots' energy",
        ),
        ("energy", energy_text(built.model)),
        *accuracy_facts(built.model.provenance),
        ("time", seconds),
        ("memory", f"{in_bytes(figures['peak_memory_bytes'])} at most"),
        ("model", f"{built.path}, {in_bytes(figures['model_bytes'])}"),
    ]
    print_facts("built", facts)
    _notice_missed_handles(built)


def _notice_missed_handles(built: Built) -> None:
    """Prints a notice if samples do not follow their handles, which errors do not show."""
    problem, snapshots = built.model.problem, built.snapshots
    if not isinstance(problem, PosingProblem):
        return
    missed = float(np.median(handle_misses(problem, snapshots.parameters, snapshots.displacements)))
    if missed <= MISSED:
        return
    usual = usual_stiffness(problem.mesh, problem.material)
    cure = f"the stiffness is {problem.stiffness:.2g}, but {usual:.2g} is usual for this body"
    if problem.stiffness >= 0.5 * usual:
        cure = "make handles larger, or their motions smaller"
    notice(
        f"notice: samples miss their handles by {in_percent(missed)} of the motion in the median; "
        f"{cure}"
    )


def _percent(share: float) -> str:
    """A share in percent, with enough digits to differ from 100 %."""
    return f"{100 * share:.6g} %"
