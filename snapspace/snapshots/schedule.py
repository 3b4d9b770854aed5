"""Schedule: which samples are solved together, and which samples they wait for."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Schedule:
    """Blocks of samples in order, each with the earlier blocks that its starts come from.

    Starts depend on the numbers of samples only, never on what happens to be finished, so that
    results do not depend on threads, executors or interruptions.

    count : number of samples
    block : samples per block
    strict : a block starts from all earlier blocks and has to wait for them; otherwise from the
        first three fifths. The rest may still be in work: with two fifths of slack nobody waits
        for a slow sample, and early blocks do not go without starts.
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
        """The samples that a block's starts come from: they are finished before it begins."""
        blocks = index if self.strict else 3 * index // 5
        return range(0, blocks * self.block)
