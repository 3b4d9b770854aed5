"""Numbers in readable units."""

from __future__ import annotations


def in_bytes(count: int | None) -> str:
    """1.5 kB, 23 MB, ... in decimal units; "unknown" for None."""
    if count is None:
        return "unknown"
    size = float(count)
    for unit in ("bytes", "kB", "MB", "GB"):
        if size < 1000 or unit == "GB":
            return f"{size:.0f} {unit}" if unit == "bytes" else f"{size:.3g} {unit}"
        size /= 1000
    raise AssertionError("unreachable")


def in_percent(share: float) -> str:
    """A share of one in two digits, such as 0.32 % or 140 %."""
    return f"{two_digits(100 * share)} %"


def two_digits(value: float) -> str:
    """A number in two digits, without an exponent up to a million, such as 0.32 or 590."""
    return f"{float(f'{value:.2g}'):g}"


def in_time(seconds: float) -> str:
    """0.12 s, 45 s, 3 min 20 s, 2 h 05 min."""
    if seconds < 59.5:
        return f"{seconds:.2g} s" if seconds < 10 else f"{seconds:.0f} s"
    minutes, rest = divmod(round(seconds), 60)
    if minutes < 60:
        return f"{minutes} min {rest:02d} s"
    return f"{minutes // 60} h {minutes % 60:02d} min"
