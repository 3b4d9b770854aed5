"""Fuzzers for all readers of files: `python -m fuzz --seconds 120`.

Each file is a mutation of one that `corpus.py` writes. Reading it must give a valid object or a
ValueError of one line, within seconds and within a memory limit. Inputs that violate this are kept
in build/fuzz/failures; inputs of faults that were fixed are in tests/fuzz.
"""
