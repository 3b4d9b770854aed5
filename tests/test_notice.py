"""Notices are warnings, and whoever shows them elsewhere collects those of its own thread."""

from __future__ import annotations

import threading

import pytest

from snapspace.notice import Notice, collected_notices, notify


class OtherNotice(Notice):
    pass


def test_collected_notices_are_warnings_still() -> None:
    with pytest.warns(OtherNotice, match="first") as caught, collected_notices() as notices:
        notify("first", OtherNotice)
        assert notices == ["first"]
    assert caught[0].filename == __file__, "of the caller"


def test_the_innermost_takes_them_and_none_comes_later() -> None:
    with pytest.warns(Notice), collected_notices() as outer:
        with collected_notices() as inner:
            notify("within", Notice)
        notify("after", Notice)
        assert (outer, inner) == (["after"], ["within"])
    with pytest.warns(Notice, match="alone"):
        notify("alone", Notice)
    assert outer == ["after"]


def test_an_error_ends_it() -> None:
    with pytest.raises(KeyError), collected_notices() as notices:
        raise KeyError
    with pytest.warns(Notice):
        notify("later", Notice)
    assert notices == []


def test_other_threads_have_their_own() -> None:
    with pytest.warns(Notice), collected_notices() as notices:
        other = threading.Thread(target=notify, args=("of another thread", Notice))
        other.start()
        other.join()
    assert notices == []
