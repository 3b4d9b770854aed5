"""A picture is written completely or not at all."""

from __future__ import annotations

import numpy as np
import pytest
from PIL import Image

from snapspace.pictures import save_png

IMAGE = np.random.default_rng(0).integers(0, 256, (7, 11, 3), dtype=np.uint8)


def test_the_pixels_are_read_back(tmp_path):
    written = save_png(tmp_path / "a.png", IMAGE)
    with Image.open(written) as image:
        assert np.array_equal(np.asarray(image), IMAGE)
    assert [p.name for p in tmp_path.iterdir()] == ["a.png"]


def test_a_failed_write_leaves_the_old_picture_and_nothing_else(tmp_path, monkeypatch):
    target = save_png(tmp_path / "a.png", IMAGE)
    before = target.read_bytes()

    def fail(self, file, **options):
        file.write_bytes(b"half")
        raise OSError("disk full")

    monkeypatch.setattr(Image.Image, "save", fail)
    with pytest.raises(ValueError, match=r"a\.png: cannot be written: disk full"):
        save_png(target, 255 - IMAGE)
    assert target.read_bytes() == before
    assert [p.name for p in tmp_path.iterdir()] == ["a.png"]


@pytest.mark.parametrize(
    ("name", "image", "message"),
    [
        ("a.jpg", IMAGE, r"does not end in \.png; name it a\.png"),
        ("a", IMAGE, r"does not end in \.png"),
        ("no/such/a.png", IMAGE, r"folder .*such does not exist; create it first"),
        ("a.png", IMAGE.astype(float), r"image has shape \(7, 11, 3\) and type float64"),
        ("a.png", IMAGE[..., 0], r"image has shape \(7, 11\)"),
        ("a.png", IMAGE[:0], r"image has shape \(0, 11, 3\)"),
    ],
)
def test_bad_images_and_bad_paths_are_refused(tmp_path, name, image, message):
    with pytest.raises(ValueError, match=message):
        save_png(tmp_path / name, image)
    assert list(tmp_path.iterdir()) == []


def test_a_folder_is_not_overwritten(tmp_path):
    (tmp_path / "a.png").mkdir()
    with pytest.raises(ValueError, match="is a folder"):
        save_png(tmp_path / "a.png", IMAGE)
