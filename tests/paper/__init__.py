"""Tests of the paper's experiments and of the rivals in them."""
