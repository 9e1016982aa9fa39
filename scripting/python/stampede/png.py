"""Pictures as PNG files, by way of Pillow."""

from __future__ import annotations

import io
from typing import Any

from numpy.typing import NDArray


def pillow(extra: str) -> Any:
    """Pillow's module Image; `extra`: with which it is installed."""
    try:
        from PIL import Image
    except ImportError as error:
        raise ImportError(f'Pillow is missing\n    pip install "stampede-sim[{extra}]"') from error
    return Image


def png_of(picture: NDArray[Any], extra: str) -> bytes:
    """A PNG file of height x width x 3 uint8, or of height x width uint16. Quick rather than small."""
    file = io.BytesIO()
    pillow(extra).fromarray(picture).save(file, "PNG", compress_level=1)
    return file.getvalue()
