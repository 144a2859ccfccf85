"""Show a design in a notebook: HTML with a drawing of its tracks (SVG) and a table of its clips."""

from html import escape

import numpy as np

from skinsource.base.conventions import Floats
from skinsource.base.errors import InvalidInputError, counted, sentence
from skinsource.design.amplitudes import amplitude_text
from skinsource.design.design import Design, Input, audible_indices
from skinsource.design.labels import SCALINGS, label_of, limb_label
from skinsource.design.signal_path import drive_of_clips
from skinsource.limbs.locations import input_name
from skinsource.limbs.own_limbs import facts_of

_LABEL_PX, _LANE_PX, _LANES_PX, _AXIS_PX, _EDGE_PX = 130, 460, 36, 18, 8
_COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")
_INK, _DIM, _QUIET = "#222222", "#888888", "#BBBBBB"
_TICKS_S = (0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 30.0, 60.0, 300.0, 3600.0)
_MOST_TICKS = 8


def _lane(
    track: Input, label: str, middle: float, colour: str, end_s: float, sample_rate_hz: float
) -> list[str]:
    left = _LABEL_PX + _EDGE_PX
    elements = [
        f'<text x="{_EDGE_PX}" y="{middle + 4:.1f}" fill="{_INK}">{escape(label)}</text>',
        f'<line x1="{left}" x2="{left + _LANE_PX}" y1="{middle}" y2="{middle}" stroke="#DDDDDD"/>',
    ]
    try:
        first, drive = drive_of_clips(track.clips, track.gain_curve, sample_rate_hz, track.location)
    except InvalidInputError as error:
        message = escape(sentence(str(error))[:90])
        text = f'<text x="{left}" y="{middle - 3:.1f}" fill="{_DIM}" font-size="9">{message}</text>'
        return [*elements, text]
    if drive.silent:
        return elements
    size = float(np.abs(drive.samples).max())
    scale = _LANE_PX / (end_s * sample_rate_hz)
    # Of two points in each pixel, whole pixels are enough.
    digits = 1 if scale >= 1.0 else 0
    points = " ".join(
        f"{left + x:.{digits}f},{middle - 0.44 * _LANES_PX * y:.{digits}f}"
        for x, y in _outline(drive.samples / size, first * scale, scale)
    )
    line = f'<polyline points="{points}" fill="none" stroke="{colour}" stroke-width="1"/>'
    return [*elements, line]


def _outline(samples: Floats, start: float, scale: float) -> list[tuple[float, float]]:
    """Return points of a curve; of samples in one pixel the lowest and the highest."""
    x = start + np.arange(samples.size) * scale
    if scale >= 1.0:
        return list(zip(x.tolist(), samples.tolist(), strict=True))
    first = np.flatnonzero(np.diff(np.floor(x), prepend=-1.0))
    low, high = np.minimum.reduceat(samples, first), np.maximum.reduceat(samples, first)
    columns = np.floor(x[first]).tolist()
    pairs = zip(columns, low.tolist(), high.tolist(), strict=True)
    return [(column, value) for column, *values in pairs for value in values]


def _axis(top: float, end_s: float) -> list[str]:
    left = _LABEL_PX + _EDGE_PX
    step = next((tick_s for tick_s in _TICKS_S if end_s / tick_s <= _MOST_TICKS), _TICKS_S[-1])
    elements = []
    for k in range(int(end_s / step + 1e-9) + 1):
        x = left + k * step / end_s * _LANE_PX
        text = f"{1e3 * k * step:g}" if step < 1.0 else f"{k * step:g}"
        elements.append(f'<line x1="{x:.1f}" x2="{x:.1f}" y1="0" y2="{top}" stroke="#EEEEEE"/>')
        elements.append(
            f'<text x="{x:.1f}" y="{top + 13}" fill="{_DIM}" text-anchor="middle">{text}</text>'
        )
    unit = "ms" if step < 1.0 else "s"
    return [*elements, f'<text x="{_EDGE_PX}" y="{top + 13}" fill="{_DIM}">Time ({unit})</text>']


# With these the HTML takes less than 200 kB, whatever is played.
_MOST_TRACKS, _MOST_CLIPS, _MOST_LETTERS = 20, 40, 200


def html_of(design: Design) -> str:
    """Return HTML that needs no other files."""
    title = escape(design.title) or "Design"
    limb = escape(limb_label(design.limb).both)
    scaling = escape(label_of(SCALINGS, design.scaling).title)
    parts = [f"<p><b>{title}</b><br>{limb} · scaling: {scaling}</p>"]
    inputs = design.inputs[:_MOST_TRACKS]
    if not inputs:
        return "".join([*parts, "<p>No inputs.</p>"])
    end_s = max((clip.end_s for clip in design.clips), default=0.0)
    end_s = max(end_s, 0.02)
    # Drives are drawn at the sample rate of the limb.
    rate_hz = facts_of(design.limb).sample_rate_hz
    audible = audible_indices(design.inputs)
    # At the right half of the last time has room.
    width = _LABEL_PX + _LANE_PX + 3 * _EDGE_PX
    height = _LANES_PX * len(inputs) + _AXIS_PX + _EDGE_PX
    parts += [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" '
        f'viewBox="0 0 {width} {height}" font-family="sans-serif" font-size="11" role="img">',
        f'<rect width="{width}" height="{height}" fill="white"/>',
    ]
    for row, track in enumerate(inputs):
        colour = _COLOURS[row % len(_COLOURS)] if row in audible else _QUIET
        label = _place(track.location, design.limb)
        parts += _lane(track, label, _LANES_PX * (row + 0.5), colour, end_s, rate_hz)
    parts += [*_axis(_LANES_PX * len(inputs), end_s), "</svg>", _table(design)]
    return "".join(parts)


def _table(design: Design) -> str:
    rows = [
        (track.location, amplitude_text(design, track), clip)
        for track in design.inputs[:_MOST_TRACKS]
        for clip in track.clips
    ]
    cells = [
        f"<tr><td>{location}</td><td>{amplitude}</td><td>{1e3 * clip.onset_s:g} ms</td>"
        f"<td>{escape(clip.waveform.title)}</td><td>{escape(_shortened(str(clip.waveform)))}</td></tr>"
        for location, amplitude, clip in rows[:_MOST_CLIPS]
    ]
    left_out = len(design.clips) - len(cells)
    more = f"<p>… and {counted(left_out, 'more clip')}</p>" if left_out > 0 else ""
    heads = ("Place", "Amplitude", "Onset", "Waveform", "")
    head = "".join(f"<th>{title}</th>" for title in heads)
    return f"<table><tr>{head}</tr>{''.join(cells)}</table>{more}"


def _shortened(text: str) -> str:
    return text if len(text) <= _MOST_LETTERS else f"{text[:_MOST_LETTERS]}…"


def _place(location: int, limb: str) -> str:
    exists = 1 <= location <= facts_of(limb).n_inputs
    return f"{location} {input_name(location, limb).short_name}" if exists else f"place {location}"
