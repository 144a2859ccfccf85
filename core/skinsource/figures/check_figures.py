"""Figures of linearity and superposition, as the model has them by construction."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import scipy

from skinsource.analysis.bands import BIN_HZ, band_rms
from skinsource.arrays import Floats
from skinsource.chain import amplitude_unit
from skinsource.errors import InvalidInputError
from skinsource.evaluation import evaluate
from skinsource.figures.sheet import Drawn, Sheet, Table
from skinsource.figures.values import field_of, frequency_of, normal_of
from skinsource.limb import Band
from skinsource.own_limbs import facts_of
from skinsource.plot.paper import COLOURS, INK, style
from skinsource.quoting import quoted
from skinsource.resampling import finer
from skinsource.scenes import OpenedScene
from skinsource.validation.agreement import pearson
from skinsource.validation.linearity import straight_lines
from skinsource.waveforms import Chirp

_SHOWN_BANDS_HZ = (50.0, 100.0, 200.0, 400.0)
# Where an error is exactly 0 it is drawn here.
_SMALLEST = 1e-17
_CYCLES_SHOWN = 4.0


def strengths(opened: OpenedScene) -> Drawn:
    """Each tone at five strengths, divided by them, over each other."""
    view = opened.view
    found = [
        evaluate(one.design, "response_time_s", "selected_traces", view=view)
        for one in opened.conditions
    ]
    time_s = found[0]["response_time_s"]
    factors = np.array([one.design.inputs[0].amplitude for one in opened.conditions])
    alike = np.stack([one["selected_traces"] for one in found]) / factors[:, None, None]
    drawn_s, drawn = finer(time_s, alike)
    clips = opened.design.inputs[0].clips
    delay_s = facts_of(opened.design.limb).pre_trigger_delay_s
    sheet, columns, header = Sheet(opened, 78.0), [time_s], ["time_s"]
    with style():
        for row, number in enumerate(view.outputs):
            for column, clip in enumerate(clips):
                ax = sheet.axes(22.0 + 52.0 * column, 46.0 - 34.0 * row, 46.0, 24.0)
                middle = clip.onset_s + clip.duration_s / 2.0 + delay_s
                half = _CYCLES_SHOWN / (2.0 * frequency_of(clip))
                within = np.abs(drawn_s - middle) <= half
                _overlay(ax, opened, 1e3 * drawn_s[within], drawn[:, row, within])
                ax.set_title(f"{frequency_of(clip):g} Hz: {ax.get_title()}", fontsize=6)
                ax.set_ylabel("" if column else f"Output {number}\nz / strength")
                ax.set_xlabel("" if row + 1 < len(view.outputs) else "Time (ms)")
            columns += list(alike[:, row])
            per = f"output_{number} per {amplitude_unit(opened.design)}"
            header += [f"{per} at {one.label}" for one in opened.conditions]
        handles = ax.get_legend_handles_labels()
        sheet.figure.legend(*handles, loc="upper right", ncols=5, fontsize=6)
    return Drawn(sheet=sheet, tables={"": Table(header=header, rows=np.vstack(columns).T)})


def _overlay(ax: Any, opened: OpenedScene, time_ms: Floats, curves: Floats) -> None:
    for k, curve in enumerate(curves):
        # Thinner from one to the next, so that all of them can be seen.
        width, label = 4.5 - 0.95 * k, opened.conditions[k].label
        ax.plot(time_ms, curve, color=COLOURS[k], lw=width, label=label)
    apart = float(np.ptp(curves, axis=0).max()) / float(np.abs(curves).max())
    ax.set_title(f"differences up to {apart:.0e} of the peak" if apart else "no difference")
    ax.set_yticks([])
    ax.locator_params(axis="x", nbins=4)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Fits:
    """Straight lines of output over input, in bands of 2 Hz.

    Attributes
    ----------
    frequency_hz : (n_bands,)
        Middles of the bands.
    played : (n_levels, n_bands)
        RMS of the input there.
    felt : (n_levels, n_channels, n_bands)
        Those of the outputs.
    slope, offset, adjusted_r2 : (n_channels, n_bands)
        Of the lines.
    """

    frequency_hz: Floats
    played: Floats
    felt: Floats
    slope: Floats
    offset: Floats
    adjusted_r2: Floats


def swept_hz(opened: OpenedScene) -> Band:
    """From where to where the sweep of a scene goes, as far as its limb was measured there.

    Raises
    ------
    InvalidInputError
        The limb was measured nowhere there.
    """
    (clip,) = opened.design.inputs[0].clips
    if not isinstance(clip.waveform, Chirp):
        raise TypeError(f"{clip.waveform} is no sweep")
    limb, swept = opened.design.limb, (clip.waveform.start_hz, clip.waveform.end_hz)
    known = facts_of(limb).band_hz or (0.0, np.inf)
    low_hz, high_hz = max(known[0], min(swept)), min(known[1], max(swept))
    if high_hz - low_hz < BIN_HZ:
        raise InvalidInputError(
            f"the sweep of this scene goes from {min(swept):g} to {max(swept):g} Hz, and the limb "
            f"{quoted(limb)} was measured from {known[0]:g} to {known[1]:g} Hz, expected "
            f"{BIN_HZ:g} Hz or more in common. Choose another limb."
        )
    return low_hz, high_hz


def lines_of(opened: OpenedScene) -> Fits:
    """Fit a line for each output and band, by least squares over the levels of the scene."""
    swept = swept_hz(opened)
    played, felt, frequency_hz = [], [], np.zeros(0)
    for one in opened.conditions:
        found = evaluate(one.design, "input_waveforms", "sample_rate_hz")
        (waveform,) = found["input_waveforms"]
        _, field = field_of(one.design)
        drive = waveform * one.design.inputs[0].amplitude
        n_times = field.shape[-1]
        how = n_times, found["sample_rate_hz"], swept
        frequency_hz, of_drive = band_rms(scipy.fft.rfft(drive, n_times), *how)
        played.append(of_drive)
        felt.append(band_rms(scipy.fft.rfft(normal_of(one.design, field)), *how)[1])
    x, y = np.stack(played), np.stack(felt)
    slope, offset, adjusted_r2 = straight_lines(x[:, None], y)
    return Fits(
        frequency_hz=frequency_hz,
        played=x,
        felt=y,
        slope=slope,
        offset=offset,
        adjusted_r2=adjusted_r2,
    )


def output_over_input(opened: OpenedScene) -> Drawn:
    """Output over input of some bands, with their lines."""
    fits, outputs, unit = lines_of(opened), opened.view.outputs, amplitude_unit(opened.design)
    sheet = Sheet(opened, 70.0)
    bands = [int(np.argmin(np.abs(fits.frequency_hz - one))) for one in _SHOWN_BANDS_HZ]
    with style():
        for k, number in enumerate(outputs):
            ax = sheet.axes(22.0 + 84.0 * k, 12.0, 66.0, 50.0)
            for colour, marker, band in zip(COLOURS, "os^D", bands, strict=False):
                x = fits.played[:, band]
                line = fits.slope[number - 1, band] * x + fits.offset[number - 1, band]
                r2 = fits.adjusted_r2[number - 1, band]
                label = f"{fits.frequency_hz[band]:.0f} Hz, adjusted R² {r2:.6f}"
                ax.loglog(x, line, color=colour, lw=0.8)
                felt = fits.felt[:, number - 1, band]
                ax.loglog(x, felt, marker, ms=4, mfc="none", color=colour, label=label)
            ax.set_title(f"Output {number}, z")
            ticks = fits.played[:, bands[0]]
            ax.set_xticks(ticks, [f"{one:.2g}" for one in ticks])
            ax.minorticks_off()
            ax.set_xlabel(f"Input in the band ({unit})")
            ax.set_ylabel("Output in the band (m/s²)")
            ax.legend(fontsize=6, loc="upper left")
            low, high = ax.get_ylim()
            ax.set_ylim(low, high * 12.0)
    header, columns = ["frequency_hz"], [fits.frequency_hz]
    for level, one in enumerate(opened.conditions):
        header += [f"input at {one.label} ({unit})"]
        header += [f"output_{number} at {one.label} (m/s²)" for number in outputs]
        columns += [fits.played[level], *(fits.felt[level, number - 1] for number in outputs)]
    return Drawn(sheet=sheet, tables={"": Table(header=header, rows=np.vstack(columns).T)})


def straightness(opened: OpenedScene) -> Drawn:
    """How far adjusted R² is from 1, over all outputs."""
    fits = lines_of(opened)
    short = float(1.0 - fits.adjusted_r2.min())
    sheet = Sheet(opened, 62.0)
    with style():
        ax = sheet.axes(26.0, 12.0, 146.0, 44.0)
        for words, values, colour, width in (
            ("worst output", fits.adjusted_r2.min(axis=0), COLOURS[1], 2.5),
            ("median of all outputs", np.median(fits.adjusted_r2, axis=0), COLOURS[0], 0.8),
        ):
            ax.plot(fits.frequency_hz, values, color=colour, lw=width, label=words)
        ax.set_xlim(*swept_hz(opened))
        ax.set_ylim(min(0.99, 1.0 - 1.2 * short), 1.001)
        ax.set_xlabel("Frequency (Hz)")
        ax.set_ylabel("Adjusted R²")
        ax.legend(loc="lower right", ncols=2)
        words = f"1 − adjusted R² is at most {short:.0e}" if short > 0.0 else "1 to the last digit"
        ax.text(0.02, 0.06, words, transform=ax.transAxes)
    numbers = range(1, fits.adjusted_r2.shape[0] + 1)
    header = ["frequency_hz", *(f"output_{k}_adjusted_r2" for k in numbers)]
    rows = np.vstack((fits.frequency_hz, fits.adjusted_r2)).T
    return Drawn(sheet=sheet, tables={"": Table(header=header, rows=rows)})


def superposition(opened: OpenedScene) -> Drawn:
    """The sum of what each input causes beside what both cause, and their correlation."""
    fields = [field_of(one.design) for one in opened.conditions]
    time_s, joint = fields[-1]
    separate = fields[0][1] + fields[1][1]
    worst = pearson(separate, joint).min(axis=1)
    outputs, header = opened.view.outputs, ["time_s"]
    normal = normal_of(opened.design, separate), normal_of(opened.design, joint)
    columns = [time_s]
    sheet = Sheet(opened, 70.0)
    with style():
        _draw_sums(sheet, outputs, time_s, *normal)
        ax = sheet.axes(112.0, 12.0, 62.0, 46.0)
        numbers = np.arange(1, worst.size + 1)
        ax.semilogy(numbers, np.maximum(1.0 - worst, _SMALLEST), "o", ms=2.5, color=COLOURS[0])
        ax.set_ylim(_SMALLEST, 1.0)
        ax.axhline(0.01, color=COLOURS[1], lw=0.8)
        ax.text(1.0, 0.013, "r = 0.99", color=COLOURS[1], fontsize=6, va="bottom")
        ax.set_xlabel("Output")
        ax.set_ylabel("1 − Pearson r, worst axis")
        ax.set_title("0 is drawn at the foot", fontsize=6)
    for number in outputs:
        header += [f"output_{number}_z_separate_m_per_s2", f"output_{number}_z_joint_m_per_s2"]
        columns += [one[number - 1] for one in normal]
    numbers_and_r = np.column_stack((numbers.astype(float), worst))
    return Drawn(
        sheet=sheet,
        tables={
            "": Table(header=header, rows=np.vstack(columns).T),
            "-correlation": Table(header=["output", "pearson_r"], rows=numbers_and_r),
        },
    )


def _draw_sums(
    sheet: Sheet, outputs: Sequence[int], time_s: Floats, separate: Floats, joint: Floats
) -> None:
    """Some cycles in the middle of the sweep, along the axis normal to the skin."""
    chosen = np.array(outputs) - 1
    drawn_s, (apart, together) = finer(time_s, np.stack((separate, joint))[:, chosen])
    within = (drawn_s > 1.0) & (drawn_s < 1.05)
    for k, number in enumerate(outputs):
        ax = sheet.axes(26.0, 40.0 - 28.0 * k, 66.0, 20.0)
        ax.plot(
            1e3 * drawn_s[within],
            apart[k, within],
            color=COLOURS[5],
            lw=3.0,
            label="sum of separate",
        )
        ax.plot(1e3 * drawn_s[within], together[k, within], color=INK, lw=0.8, label="joint")
        ax.set_ylabel(f"Output {number}\nz (m/s²)")
        if k == 0:
            ax.legend(fontsize=6, loc="lower right", bbox_to_anchor=(1.0, 0.98), ncols=2)
    ax.set_xlabel("Time (ms)")
