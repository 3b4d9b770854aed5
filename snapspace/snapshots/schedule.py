"""Schedule: which samples are solved together, and which ones they wait for."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass


@dataclass(frozen=True)
class Schedule:
    """Blocks of samples in order, each with the earlier blocks that supply its starts.

    Starts depend only on the samples, never on which ones happen to be finished first. So results
    do not depend on threads, executors or interruptions.

    count : number of samples
    block : samples per block
    strict : whether a block starts from all earlier blocks and waits for them. Otherwise it uses
        the first three quarters of the blocks before it, and in each of these the three quarters of
        the samples that took the fewest evaluations, so that no block waits for slow samples.
    """

    count: int
    block: int
    strict: bool

    def __len__(self) -> int:
        return -(-self.count // self.block)

    def samples(self, index: int) -> range:
        """The samples of a block."""
        begin = index * self.block
        return range(begin, min(begin + self.block, self.count))

    def before(self, index: int) -> range:
        """The blocks that supply a block's starts."""
        return range(index if self.strict else 3 * index // 4)

    def waited_for(self, index: int) -> int:
        """Number of samples of a block for which later blocks wait."""
        size = len(self.samples(index))
        return size if self.strict else -(-3 * size // 4)

    def quick(
        self, index: int, finished: Mapping[int, int], running: Mapping[int, int]
    ) -> list[int] | None:
        """The samples of a block from which later blocks start; None while these are not certain.

        finished, running : evaluations by sample, final ones or those so far
        """
        done = sorted((finished[i], i) for i in self.samples(index) if i in finished)
        wanted = self.waited_for(index)
        if len(done) < wanted:
            return None
        last = done[wanted - 1]
        # an unfinished sample might still end with fewer
        for i in self.samples(index):
            if i not in finished and running.get(i, 0) <= last[0]:
                return None
        return sorted(i for _, i in done[:wanted])
