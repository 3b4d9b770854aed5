"""How many samples the fast solver takes together."""

from __future__ import annotations


def lane_count(samples: int, *, single: bool = False) -> int:
    """Samples per pack for a run of so many; processors with narrower registers take fewer.

    A pack costs nearly the same whether full or not, and twice as many samples in single precision
    cost as much as one in double. So packs are as wide as leaves several for the threads. It
    depends on the number of samples only, not on the threads there are nor on what is done already,
    since packs of another width round differently.
    """
    wide = 8 if samples >= 24 else 4 if samples >= 8 else 2
    return 2 * wide if single else wide
