"""The paper's experiments as programs, with rival subspaces and rival evaluations."""
