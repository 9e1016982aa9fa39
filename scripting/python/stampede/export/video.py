"""Films of one camera: constant rate, a frame's time from its number, a key frame at every second one."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path
from typing import Any

from stampede.export.steps import Array

# Options that make encoding quick, by PyAV's name of the encoder.
ENCODERS: dict[str, dict[str, str]] = {
    "libx264": {"preset": "veryfast", "crf": "18", "bf": "0"},
    "libsvtav1": {"preset": "12", "crf": "30"},
}
NAMES = {"libx264": "h264", "libsvtav1": "av1"}


def library() -> Any:
    """PyAV. Raises ImportError that says how to install it."""
    try:
        import av
    except ImportError as error:
        raise ImportError('av is missing\n    pip install "stampede-sim[lerobot]"') from error
    return av


def write_film(path: Path, pictures: Array, frame_hz: int, encoder: str) -> None:
    """pictures: frames x height x width x 3, uint8; height and width are even."""
    av = library()
    with av.open(str(path), "w", format="mp4") as film:
        stream = film.add_stream(encoder, rate=frame_hz, options={**ENCODERS[encoder], "g": "2"})
        stream.height, stream.width = pictures.shape[1:3]
        stream.pix_fmt = "yuv420p"
        stream.time_base = Fraction(1, frame_hz)
        stream.thread_count = 1
        for number, picture in enumerate(pictures):
            frame = av.VideoFrame.from_ndarray(picture, format="rgb24")
            frame.pts, frame.time_base = number, Fraction(1, frame_hz)
            for packet in stream.encode(frame):
                film.mux(packet)
        for packet in stream.encode(None):
            film.mux(packet)
