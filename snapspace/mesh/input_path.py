"""Paths that a user gives, checked before anything is opened."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from ..input_error import InputError


def existing_file(file: Path, *, known: Iterable[str]) -> Path:
    """The path as given; ValueError unless it is a file with one of the known extensions."""
    if file.is_dir():
        raise InputError(file, "this is a folder; a file is needed")
    if file.suffix or file.exists():
        _check_extension(file, known)
    if not file.exists():
        raise InputError(file, "there is no such file")
    return file


def writable_path(file: Path, *, known: Iterable[str]) -> Path:
    """The path as given; ValueError unless it can become a file with a known extension."""
    _check_extension(file, known)
    if file.is_dir():
        raise InputError(file, "this is a folder; give a file name")
    if not file.parent.is_dir():
        raise InputError(file, f"there is no folder {file.parent}; create it first")
    return file


def _check_extension(file: Path, known: Iterable[str]) -> None:
    suffix = file.suffix.lower()
    known = list(known)
    if suffix not in known:
        what = f"unknown extension {suffix!r}" if suffix else "no extension"
        raise InputError(file, f"{what}; known are {', '.join(known)}")
