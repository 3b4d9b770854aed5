"""Timelines: keys of handle motions or weights in time, as files that the page writes too."""

from .timeline import EASINGS, Key, Timeline
from .timeline_file import read_timeline, timeline_of, write_timeline

__all__ = ["EASINGS", "Key", "Timeline", "read_timeline", "timeline_of", "write_timeline"]
