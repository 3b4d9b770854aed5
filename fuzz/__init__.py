"""Fuzzers of everything that reads a file: `python -m fuzz --seconds 120`.

Each file is a mutation of one that `corpus.py` writes. It has to give a valid object or a
ValueError of one line, within seconds and within a bound of memory. Inputs that break this are kept
in build/fuzz/failures; those that were mended are in tests/fuzz.
"""
