"""How many samples the fast solver takes together."""

from __future__ import annotations


def lane_count(samples: int) -> int:
    """Samples per pack for a wave of so many; processors with narrower registers take fewer.

    Packs of 2, 4 and 8 cost 11, 13 and 18 ms an iteration on the Lion, whether full or not. So they
    are as wide as leaves several for the threads. It depends on the size of the wave only, not on
    the threads there are nor on what of it is done, since packs of another width round differently.
    """
    return 8 if samples >= 24 else 4 if samples >= 8 else 2
