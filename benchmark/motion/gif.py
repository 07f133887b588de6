"""A motion beside the truth as an animated GIF: stick figures seen from the side."""

from __future__ import annotations

from io import BytesIO

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

from mocapbench.reports import Motions

__all__ = ["gif_bytes"]

WIDTH, HEIGHT = 480, 400
_MARGIN = 40
_PAPER, _INK, _HUE, _RULE, _SHADE = "#ffffff", "#8b949e", "#0b62a4", "#d5dae0", "#f3e4cf"
_SMOOTHING = 2
"""Frames are drawn this much larger, and made smaller again."""

Points = NDArray[np.float64]


def gif_bytes(picture: Motions, title: str) -> bytes:
    """Return the first motion of ``picture`` in blue over the truth in grey.

    Frames of which something was hidden have a tinted ground, and a bar below shows the progress.
    The body stays in the middle: the view follows the truth. A GIF counts time in hundredths of a
    second, to which the interval between frames is rounded.

    Parameters
    ----------
    picture : Motions
        Seen along its z axis.
    title : str
        Written above.
    """
    label, made = next(iter(picture.motions.items()))
    truth = picture.truths[picture.truth_of(label)]
    centre = truth[:, :1] * [1.0, 0.0, 1.0]
    scale = (HEIGHT - 3 * _MARGIN) / max(float(truth[..., 1].max()), 1.0)
    drawn = [_on_paper(positions - centre, scale) for positions in (truth, made)]
    frames = [_frame(picture, k, [places[k] for places in drawn], title) for k in range(len(truth))]
    buffer = BytesIO()
    length = max(round(picture.interval * 100) * 10, 20)
    frames[0].save(buffer, "GIF", save_all=True, append_images=frames[1:], duration=length, loop=0)
    return buffer.getvalue()


def _on_paper(positions: Points, scale: float) -> Points:
    """Return pixels to the right and down (T, J, 2) of joints around the middle."""
    flat = positions[..., :2] * [scale, -scale]
    return np.asarray(np.add(flat, [WIDTH / 2, HEIGHT - 1.5 * _MARGIN]))


def _frame(picture: Motions, frame: int, bodies: list[Points], title: str) -> Image.Image:
    size = (_SMOOTHING * WIDTH, _SMOOTHING * HEIGHT)
    image = Image.new("RGB", size, _SHADE if picture.hidden[frame] else _PAPER)
    pen = ImageDraw.Draw(image)
    _draw_ground(pen)
    for places, colour, width in zip(bodies, (_INK, _HUE), (7, 4), strict=True):
        _draw_body(pen, _SMOOTHING * places, picture.parents, colour, width * _SMOOTHING)
    _draw_progress(pen, picture.hidden, frame)
    small = image.resize((WIDTH, HEIGHT), Image.Resampling.LANCZOS)
    label = f"{frame * picture.interval:.2f} s" + (", hidden" if picture.hidden[frame] else "")
    words = ImageDraw.Draw(small)
    words.text((8, 6), title, fill="#1c2126")
    truth = picture.truth_of(next(iter(picture.motions)))
    words.text((8, 20), f"grey: {truth} · {label}", fill="#57606a")
    return small.quantize(16)


def _draw_ground(pen: ImageDraw.ImageDraw) -> None:
    height = _SMOOTHING * (HEIGHT - 1.5 * _MARGIN)
    pen.line((0, height, _SMOOTHING * WIDTH, height), _RULE, _SMOOTHING)


def _draw_body(
    pen: ImageDraw.ImageDraw, places: Points, parents: tuple[int, ...], colour: str, width: int
) -> None:
    """Draw the bones, with round ends."""
    for joint, parent in enumerate(parents):
        x, y = places[joint].tolist()
        pen.ellipse((x - width / 2, y - width / 2, x + width / 2, y + width / 2), colour)
        if parent >= 0:
            pen.line([*places[parent].tolist(), x, y], colour, width)


def _draw_progress(pen: ImageDraw.ImageDraw, hidden: NDArray[np.bool_], frame: int) -> None:
    """Draw a bar of all frames, the hidden ones shaded, with a mark at this one."""
    left, right = _SMOOTHING * 12, _SMOOTHING * (WIDTH - 12)
    top, bottom = _SMOOTHING * (HEIGHT - 24), _SMOOTHING * (HEIGHT - 12)
    edges = np.linspace(left, right, len(hidden) + 1)
    pen.rectangle((left, top, right, bottom), _RULE)
    for k in np.flatnonzero(hidden).tolist():
        pen.rectangle((edges[k], top, edges[k + 1], bottom), "#d9a860")
    pen.rectangle((edges[frame], top - 8, edges[frame + 1], bottom + 8), _HUE)
