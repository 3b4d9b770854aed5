"""Model files."""

from .model_file import FORMAT, SUFFIX, VERSION, check_model_path, load, save_model

__all__ = ["FORMAT", "SUFFIX", "VERSION", "check_model_path", "load", "save_model"]
