"""largest_pca: as many dimensions as are wanted and as there are."""

from __future__ import annotations

from ..snapshots import Snapshots
from ..subspace import AffineSubspace, snapshot_pca, spanned_dimension


def largest_pca(snapshots: Snapshots, most: int, *, threads: int | None) -> AffineSubspace:
    """The PCA of snapshots, with at most so many dimensions."""
    snapshots = snapshots.with_gram(threads=threads)
    return snapshot_pca(snapshots, dimension=min(most, spanned_dimension(snapshots)))
