"""Tests; a package, so that the packages can share `shapes` and `taylor`."""
