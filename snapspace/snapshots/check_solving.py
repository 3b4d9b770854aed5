"""check_solving: refuses arguments of searches for samples before any sample is solved."""

from __future__ import annotations

from ..arguments import require_function, require_type
from .checkpoint import Checkpoint
from .solver_options import SolverOptions


def check_solving(
    who: str, options: object, checkpoint: object = None, **functions: object
) -> None:
    """Raises a ValueError in the name of `who` for an argument of another type.

    options : SolverOptions or None
    checkpoint : Checkpoint or None
    functions : arguments that must be functions or None, by name
    """
    require_type(
        who, "options", options, SolverOptions | None, "give SolverOptions(tolerance=..., ...)"
    )
    require_type(who, "checkpoint", checkpoint, Checkpoint | None, "give Checkpoint(folder)")
    for name, function in functions.items():
        require_function(who, name, function)
