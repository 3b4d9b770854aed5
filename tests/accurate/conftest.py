"""A creature to pose, and models of it that several tests compare with."""

from __future__ import annotations

import pytest

from snapspace import AccurateModel, PosingModel, PosingProblem, StableNeoHookean, accurate_model

from ..snapshots.creatures import posing_creature


@pytest.fixture(scope="session")
def motions() -> PosingProblem:
    """A creature of 5000 tets in the default material."""
    return posing_creature(5000, StableNeoHookean())


@pytest.fixture(scope="session")
def usual_motions(motions: PosingProblem) -> AccurateModel[PosingModel]:
    """Its model for the default target."""
    return accurate_model(motions)


@pytest.fixture(scope="session")
def rough_motions(motions: PosingProblem) -> AccurateModel[PosingModel]:
    """Its model for about three times the default target."""
    return accurate_model(motions, target_error=0.01)
