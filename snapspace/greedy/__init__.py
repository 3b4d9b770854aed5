"""Greedy sampling: the next samples are those where the current model is worst."""

from .batch_checkpoints import batch_checkpoint, finished_samples, greedy_key
from .error_estimates import estimated_errors
from .greedy_snapshots import BATCH, CANDIDATES, greedy_snapshots

__all__ = [
    "BATCH",
    "CANDIDATES",
    "batch_checkpoint",
    "estimated_errors",
    "finished_samples",
    "greedy_key",
    "greedy_snapshots",
]
