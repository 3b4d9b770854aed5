"""The tests are a package, so that all folders can share `shapes` and `taylor`."""
