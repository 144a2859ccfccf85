"""Figures of a vibration as it goes on: frames of a tone, windows of a train."""

from typing import Any

import numpy as np

from skinsource.evaluation import evaluate
from skinsource.figures.sheet import WIDTH_MM, Drawn, Sheet, Table
from skinsource.figures.values import field_of, frequency_of, normal_of, with_values
from skinsource.own_limbs import facts_of
from skinsource.plot.maps import HATCHED, Bar, draw_map
from skinsource.plot.paper import INK, style
from skinsource.plot.strips import WindowedLevels, draw_extent, draw_strip, windowed_levels
from skinsource.scenes import OpenedScene

# The first frame, so long after a wave can arrive: at 100 ms of the published limbs.
_N_FRAMES, _FIRST_FRAME_S = 5, 0.048
# On a linear scale the finger alone would have colours: those end where the hand has its crests.
_SHARE_OF_PEAK = 0.1


def tone_frames(opened: OpenedScene) -> Drawn:
    """Acceleration normal to the skin at instants a quarter of a cycle apart, with its sign."""
    (clip,) = opened.design.clips
    time_s, field = field_of(opened.design)
    rate_hz = 1.0 / (time_s[1] - time_s[0])
    first_s = facts_of(opened.design.limb).pre_trigger_delay_s + _FIRST_FRAME_S
    quarters = first_s + np.arange(_N_FRAMES) / (4.0 * frequency_of(clip))
    instants = np.rint((quarters - time_s[0]) * rate_hz).astype(int)
    along_z = normal_of(opened.design, field)
    normal = along_z[:, instants].T
    limit = _SHARE_OF_PEAK * float(np.abs(along_z).max())
    sheet = Sheet(opened, 84.0, maps=True)
    with style():
        image: Any = None
        places = sheet.row_of_axes(_N_FRAMES, 4.0, 2.0, 146.0, 76.0)
        for k, (ax, values) in enumerate(zip(places, normal, strict=True)):
            bar: Bar = "drawn" if k == _N_FRAMES - 1 else "room"
            title = f"{1e3 * time_s[instants[k]]:.1f} ms"
            shown = with_values(opened.design, values)
            image = draw_map(ax, shown, (-limit, limit), title=title, signed=True, bar=bar)
        words = f"z, m/s²; colours end at {_SHARE_OF_PEAK:.0%} of the peak"
        sheet.colour_bar(image, 153.0, 20.0, 48.0, words)
    header = ["output", *(f"z at {1e3 * time_s[k]:.3f} ms (m/s²)" for k in instants)]
    numbers = np.arange(1.0, normal.shape[1] + 1.0)
    table = Table(header=header, rows=np.vstack((numbers, normal)).T)
    return Drawn(sheet=sheet, tables={"": table})


def train_windows(opened: OpenedScene) -> Drawn:
    """The train, a map for each of its windows in one scale, and how far each reaches."""
    window_s = opened.view.window_s
    found = windowed_levels(opened.design, opened.view, count=None, window_s=window_s)
    n = found.windows.count
    sheet = Sheet(opened, 132.0, f"{HATCHED}." if any(found.noisy) else "", maps=True)
    left_mm, width_mm = 22.0, WIDTH_MM - 44.0
    with style():
        train = sheet.axes(left_mm, 113.0, width_mm, 16.0)
        _draw_stimulus(train, opened, n * window_s)
        draw_strip(sheet.figure, sheet.row_of_axes(n, left_mm, 30.0, width_mm, 74.0), found, None)
        draw_extent(sheet.axes(left_mm, 6.0, width_mm, 20.0), found, n)
    return Drawn(sheet=sheet, tables={"": _table(found)})


def _draw_stimulus(ax: Any, opened: OpenedScene, until_s: float) -> None:
    found = evaluate(opened.design, "input_waveforms", "sample_rate_hz")
    (waveform,) = found["input_waveforms"]
    ax.plot(np.arange(waveform.size) / found["sample_rate_hz"], waveform, color=INK, lw=0.7)
    ax.set_xlim(0.0, until_s)
    ax.set_axis_off()
    ax.annotate(
        "Input",
        (0.0, 0.5),
        xycoords="axes fraction",
        xytext=(-8, 0),
        ha="right",
        va="center",
        textcoords="offset points",
    )


def _table(found: WindowedLevels) -> Table:
    bounds = found.windows.bounds_s(found.sample_rate_hz)
    extents = [one for one in found.extents if one is not None]
    header = ["from_s", "to_s", "mean_distance_mm", "d90_mm", "share_above_12_db"]
    header += ["share_above_20_db", "participation"]
    header += [f"output_{k}_rms_m_per_s2" for k in range(1, found.rms.shape[1] + 1)]
    rows = [
        [
            *span,
            one.mean_distance_mm,
            one.d90_mm,
            one.share_above_12_db,
            one.share_above_20_db,
            one.participation,
            *rms,
        ]
        for span, one, rms in zip(bounds, extents, found.rms, strict=True)
    ]
    return Table(header=header, rows=np.array(rows))
