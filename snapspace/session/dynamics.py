"""Dynamics: the settings of steps in time."""

from __future__ import annotations

from dataclasses import dataclass

from ..arguments import is_finite, shown
from .finite_input import finite


@dataclass(frozen=True)
class Dynamics:
    """How a body swings after the motions of its handles, or of its weights.

    frequency : frequency of the body's softest vibration in Hz, default 2. It sets the density,
    since a model has moduli and lengths, but no unit of time
    damping : damping ratio of that vibration, default 0.05. Implicit Euler adds about pi *
    frequency * dt
    gravity : acceleration (3,) in lengths per square second, in world coordinates, default zero.
    The body hangs from its handles; a blend has none and would fall

    Raises
    ------
    ValueError
        For a frequency that is not positive, a negative damping, or a number that is not finite.
    """

    frequency: float = 2.0
    damping: float = 0.05
    gravity: tuple[float, float, float] = (0.0, 0.0, 0.0)

    def __post_init__(self) -> None:
        if not (is_finite(self.frequency) and self.frequency > 0.0):
            raise ValueError(f"Dynamics: frequency {shown(self.frequency)} must be positive, in Hz")
        if not (is_finite(self.damping) and self.damping >= 0.0):
            raise ValueError(
                f"Dynamics: damping {shown(self.damping)} must be finite and not negative"
            )
        finite(self.gravity, (3,), "Dynamics: gravity")
