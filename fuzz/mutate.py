"""Mutations of files: changed bytes, binary numbers and tokens of text."""

from __future__ import annotations

import re
from random import Random

#: Tokens that are hard for readers of text.
TOKENS = [
    b"nan", b"inf", b"-inf", b"1e400", b"-1e308", b"1e-320", b"-0", b"0", b"1", b"-1", b"3", b"255",
    b"256", b"65536", b"2147483647", b"2147483648", b"-2147483649", b"4294967296",
    b"9007199254740993", b"9223372036854775808", b"-9223372036854775809",
    b"99999999999999999999999", b"1_000", b"0x10", b"1.5", b"1,5", b"null", b"true", b"[]", b"{}",
    b'""', b"/", b"#", b"\\", b"\n", b"\r", b"\0", b"\xff\xfe", b"\xc2\xb2", "٣".encode(),
    b"x" * 300,
]  # fmt: skip
#: Binary words of 1, 2, 4 and 8 bytes, for counts, indices and numbers: signs, limits, NaN.
WORDS = [
    value.to_bytes(size, order, signed=True)
    for size in (1, 2, 4, 8)
    for value in (0, 1, -1, 2 ** (8 * size - 1) - 1, -(2 ** (8 * size - 1)), 2 ** (8 * size - 2))
    for order in ("little", "big")
] + [bytes.fromhex(word) for word in ("000000000000f87f", "000000000000f07f", "0000c07f")]
_NUMBER = re.compile(rb"[-+.\w]+")


def mutated(data: bytes, random: Random, others: list[bytes]) -> bytes:
    """The content with a few changes, which may include pieces of `others`, files of its kind."""
    for _ in range(random.choice((1, 1, 1, 2, 3, 8))):
        change = random.choice((_flip, _word, _token, _token, _cut, _remove, _repeat, _insert))
        data = _splice(data, random, others) if random.random() < 0.05 else change(data, random)
    return data


def _place(data: bytes, random: Random) -> int:
    # often in the beginning, since headers determine how the rest is read
    end = min(len(data), 400) if random.random() < 0.4 else len(data)
    return random.randint(0, end)


def _flip(data: bytes, random: Random) -> bytes:
    at = _place(data, random)
    return (
        data[:at]
        + bytes([byte ^ 1 << random.randrange(8) for byte in data[at : at + 1]])
        + (data[at + 1 :])
    )


def _word(data: bytes, random: Random) -> bytes:
    at, word = _place(data, random), random.choice(WORDS)
    return data[:at] + word + data[at + len(word) :]


def _token(data: bytes, random: Random) -> bytes:
    """Replaces the next token by another one."""
    found = _NUMBER.search(data, _place(data, random))
    if not found:
        return _insert(data, random)
    return data[: found.start()] + random.choice(TOKENS) + data[found.end() :]


def _cut(data: bytes, random: Random) -> bytes:
    return data[: random.randint(0, len(data))]


def _remove(data: bytes, random: Random) -> bytes:
    at = _place(data, random)
    return data[:at] + data[at + random.choice((1, 2, 4, 8, 40)) :]


def _repeat(data: bytes, random: Random) -> bytes:
    at = _place(data, random)
    piece = data[at : at + random.choice((1, 8, 40, 200))]
    return data[:at] + piece * random.choice((2, 2, 3, 50)) + data[at + len(piece) :]


def _insert(data: bytes, random: Random) -> bytes:
    at = _place(data, random)
    return data[:at] + random.choice(TOKENS + WORDS) + data[at:]


def _splice(data: bytes, random: Random, others: list[bytes]) -> bytes:
    other = random.choice(others)
    return data[: _place(data, random)] + other[_place(other, random) :]
