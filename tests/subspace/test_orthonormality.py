"""The check of a basis costs little and refuses what is not orthonormal."""

from __future__ import annotations

import numpy as np
import pytest
from threadpoolctl import threadpool_info

from snapspace import AffineSubspace, affine_subspace
from snapspace.subspace import orthonormality
from snapspace.subspace.orthonormality import check_orthonormal

from ..snapshots.bars import posing_bar

PROBLEM = posing_bar()


def subspace(dimension: int) -> AffineSubspace:
    given = np.random.default_rng(0).normal(size=(PROBLEM.tau.size, dimension))
    return affine_subspace(given, PROBLEM)


def test_products_stay_on_one_thread(monkeypatch: pytest.MonkeyPatch) -> None:
    """Threads of BLAS that wait for these short products would take a core from other work."""
    limits: list[int] = []
    apply_mass = orthonormality.apply_mass

    def recording(*arguments: object) -> object:
        pools = threadpool_info()
        limits.extend(int(one["num_threads"]) for one in pools if one["user_api"] == "blas")
        return apply_mass(*arguments)  # type: ignore[arg-type]

    monkeypatch.setattr(orthonormality, "apply_mass", recording)
    check_orthonormal(subspace(6), who="reduce")
    assert limits and set(limits) == {1}


@pytest.mark.parametrize("column", [0, 11])
def test_one_direction_that_is_too_long_is_refused(column: int) -> None:
    wrong = subspace(12)
    wrong.basis[:, column] *= 1.001
    with pytest.raises(ValueError, match=r"reduce: .* not M-orthonormal: .* deviates .* by"):
        check_orthonormal(wrong, who="reduce")
