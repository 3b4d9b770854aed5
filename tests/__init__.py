"""Tests; a package, so that the rooms can share `shapes` and `taylor`."""
