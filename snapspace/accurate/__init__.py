"""Models as accurate as is asked: samples and dimension follow from measured errors."""

from .accurate_blends import AccurateBlends, Step, accurate_blends

__all__ = ["AccurateBlends", "Step", "accurate_blends"]
