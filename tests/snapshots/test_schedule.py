"""Blocks partition the samples, and their starts do not depend on which samples finish first."""

from __future__ import annotations

import itertools
from random import Random

from hypothesis import given
from hypothesis import strategies as st

from snapspace.snapshots.schedule import Schedule

SCHEDULES = st.builds(Schedule, st.integers(1, 200), block=st.integers(1, 40), strict=st.booleans())
SEEDS = st.integers(0, 2**32)


def random_evaluations(schedule: Schedule, rng: Random) -> dict[int, int]:
    """Evaluations that the samples need, from few different numbers, so that many are equal."""
    return {i: rng.randint(1, 6) for i in range(schedule.count)}


@given(SCHEDULES)
def test_every_sample_is_in_one_block(schedule: Schedule) -> None:
    blocks = [schedule.samples(index) for index in range(len(schedule))]
    assert list(itertools.chain(*blocks)) == list(range(schedule.count))
    assert all(len(block) == schedule.block for block in blocks[:-1])
    assert 1 <= len(blocks[-1]) <= schedule.block


@given(SCHEDULES)
def test_starts_come_from_earlier_blocks(schedule: Schedule) -> None:
    """They are the first blocks, so one number says whether they are finished."""
    for index in range(len(schedule)):
        before = schedule.before(index)
        assert before == range(len(before)) and len(before) <= index


@given(SCHEDULES)
def test_later_blocks_start_from_no_fewer(schedule: Schedule) -> None:
    known = [len(schedule.before(index)) for index in range(len(schedule))]
    assert known == sorted(known)


@given(SCHEDULES)
def test_a_block_starts_from_three_quarters_of_those_before_it_or_all(schedule: Schedule) -> None:
    """More would have to wait for slow samples; fewer would leave early blocks without starts."""
    for index in range(len(schedule)):
        known, size = len(schedule.before(index)), len(schedule.samples(index))
        if schedule.strict:
            assert known == index
            assert schedule.waited_for(index) == size
        else:
            assert known <= 0.75 * index < known + 1
            assert 0.75 * size <= schedule.waited_for(index) < 0.75 * size + 1


@given(SCHEDULES, SEEDS)
def test_the_quick_samples_of_a_block_are_those_with_the_fewest_evaluations(
    schedule: Schedule, seed: int
) -> None:
    needed = random_evaluations(schedule, Random(seed))
    for index in range(len(schedule)):
        quick = schedule.quick(index, needed, {})
        assert quick is not None and len(quick) == schedule.waited_for(index)
        assert quick == sorted(set(quick)) and set(quick) <= set(schedule.samples(index))
        slow = set(schedule.samples(index)) - set(quick)
        if slow:
            assert max(needed[i] for i in quick) <= min(needed[i] for i in slow)


@given(SCHEDULES, SEEDS)
def test_the_quick_samples_do_not_depend_on_the_progress_of_the_others(
    schedule: Schedule, seed: int
) -> None:
    """If they were chosen too early, the starts of a block would be random."""
    rng = Random(seed)
    needed = random_evaluations(schedule, rng)
    index = rng.randrange(len(schedule))
    expected = schedule.quick(index, needed, {})
    block = schedule.samples(index)
    for _ in range(5):
        finished = {i: needed[i] for i in block if rng.random() < 0.8}
        # a running sample reports fewer evaluations than it needs, or none, as in a queue
        so_far = {i: rng.randint(0, needed[i]) for i in block if i not in finished}
        running = {i: count for i, count in so_far.items() if rng.random() < 0.8}
        assert schedule.quick(index, finished, running) in (None, expected)


@given(st.integers(4, 60), SEEDS)
def test_no_block_waits_for_a_sample_that_is_certainly_slow(block: int, seed: int) -> None:
    schedule = Schedule(block, block, strict=False)
    needed = random_evaluations(schedule, Random(seed))
    quick = schedule.quick(0, needed, {})
    assert quick is not None
    most = max(needed[i] for i in quick)
    finished = {i: needed[i] for i in quick}
    others = [i for i in range(block) if i not in finished]
    assert schedule.quick(0, finished, dict.fromkeys(others, most + 1)) == quick
    if others:
        assert schedule.quick(0, finished, {}) is None, "they may be about to finish"


@given(SCHEDULES, SEEDS)
def test_all_blocks_are_submitted_whatever_finishes_first(schedule: Schedule, seed: int) -> None:
    """Blocks are submitted in order, as soon as their starts are known."""
    rng = Random(seed)
    needed = random_evaluations(schedule, rng)
    finished: dict[int, int] = {}
    submitted = known = 0
    while len(finished) < schedule.count:
        while submitted < len(schedule) and known >= len(schedule.before(submitted)):
            submitted += 1
        running = [
            i for i in range(min(submitted * schedule.block, schedule.count)) if i not in finished
        ]
        assert running, "nothing is running, but samples are left"
        for i in rng.sample(running, rng.randint(1, len(running))):
            finished[i] = needed[i]
        while known < len(schedule) and schedule.quick(known, finished, {}) is not None:
            known += 1
    assert submitted == len(schedule)
