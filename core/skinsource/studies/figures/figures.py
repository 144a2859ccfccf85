"""The figures of the scenes: linearity and superposition, maps side by side, curves in rows.

Each is drawn on a page, a `Sheet`: heading, drawing, and notes below it.
"""

import textwrap
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from math import floor
from typing import Any

import numpy as np
import scipy

from skinsource.base.conventions import AXES, Axes, Band, Floats, axis_numbers
from skinsource.base.decibels import decibels, levels_for_tables
from skinsource.base.errors import InvalidInputError, quoted, sentence
from skinsource.design.amplitudes import amplitude_unit
from skinsource.design.clips import Clip
from skinsource.design.design import Design, View
from skinsource.design.labels import SCALINGS, label_of, limb_label, signal_label
from skinsource.design.waveforms.tones import Chirp, Tone
from skinsource.engine.evaluation import evaluate
from skinsource.export.plot import (
    COLOURS,
    DIM,
    HATCHED,
    INK,
    MM_PER_INCH,
    SYNTHETIC,
    Levels,
    PlotRow,
    Range,
    annotate_scale,
    common_range,
    common_size,
    draw_extent,
    draw_maps,
    draw_rows,
    levels_of,
    new_figure,
    style,
    windowed_levels,
)
from skinsource.export.tables import windows_table
from skinsource.limbs.own_limbs import facts_of
from skinsource.perception.validity import Judged, in_full
from skinsource.signals.analysis.statistics import BIN_HZ, band_rms
from skinsource.signals.map_range import MAP_RANGE_DB
from skinsource.signals.projection import magnitude
from skinsource.signals.resampling import finer
from skinsource.signals.sampling import NEAR, values_at
from skinsource.signals.spectra import MEAN_OF_BINS, mean_of_bins
from skinsource.studies.checking import pearson, straight_lines
from skinsource.studies.scenes.scenes import Condition, OpenedScene


def setup_text(opened: OpenedScene) -> str:
    """Return sentences on limbs and scaling."""
    scaling = label_of(SCALINGS, opened.design.scaling).title
    limbs = ", ".join(limb_label(limb).title for limb in limbs_of(opened))
    return f"Limb: {limbs}. Scaling: {scaling}."


def broken_conditions_text(opened: OpenedScene, *, maps: bool) -> str:
    """Return which conditions of the measurement are not met; "": all are.

    ``maps``: whether the figure shows maps; only these need values between outputs.
    """
    findings = [
        finding for judged in _judgements(opened, maps=maps) for finding in judged.findings or ()
    ]
    # A synthetic limb has a larger note of its own.
    broken = dict.fromkeys(
        finding.name for finding in findings if finding.state == "left" and finding.name != "limb"
    )
    heading = "Conditions of the measurement that are not met (see the table)"
    return f"{heading}: {', '.join(broken)}." if broken else ""


def condition_lines(opened: OpenedScene, *, maps: bool) -> tuple[str, ...]:
    """Return a line for each condition that is not met, with the designs that do not meet it."""
    return in_full(_judgements(opened, maps=maps))


def limbs_of(opened: OpenedScene) -> tuple[str, ...]:
    """Return the names of the limbs of a scene, each once."""
    return tuple(dict.fromkeys(condition.design.limb for condition in opened.conditions))


def _judgements(opened: OpenedScene, *, maps: bool) -> list[Judged]:
    judged = [
        Judged(
            label=condition.label,
            findings=evaluate(condition.design, "validity", view=opened.view)["validity"],
        )
        for condition in opened.conditions
    ]
    return judged if maps else [each.without_maps() for each in judged]


def field_of(design: Design) -> tuple[Floats, Floats]:
    """Return times, (n_times,), in s, and the field, (n_outputs, n_axes, n_times), in m/s²."""
    limb = evaluate(design, "limb_data")["limb_data"]
    view = View(axes="xyz", outputs=tuple(range(1, limb.n_outputs + 1)))
    results = evaluate(design, "response_time_s", "axis_traces", view=view)
    return results["response_time_s"], results["axis_traces"]


def axes_of_sensors(design: Design) -> tuple[Axes, ...]:
    """Return the single axes along which the limb of a design was measured."""
    measured = facts_of(design.limb).axes
    return tuple(axis for axis in AXES if len(axis) == 1 and axis in measured)


def normal_of(design: Design, field: Floats) -> Floats:
    """Return the part of a field that is normal to the skin, z, (n_outputs, n_times)."""
    (normal,) = axis_numbers("z", facts_of(design.limb).axes)
    return field[:, normal]


def frequency_of(clip: Clip) -> float:
    """Return the frequency of the tone that a clip plays, Hz."""
    if not isinstance(clip.waveform, Tone):
        raise TypeError(f"{clip.waveform} is no tone")
    return clip.waveform.frequency_hz


def levels_of_values(design: Design, values: Floats) -> Levels:
    """Return any values at the outputs for a map, with the input places of the design.

    Nothing is hatched: the noise of the whole record says little of an instant.
    """
    return replace(levels_of(design, None, None), values=np.asarray(values), noisy=())


#: Width of two columns of a journal.
WIDTH_MM = 180.0
_EDGE_MM, _HEAD_MM, _LINE_MM, _FOOT_EDGE_MM = 4.0, 9.0, 3.2, 3.0
_LINE_CHARACTERS = 128


class Sheet:
    """A page for a drawing.

    Parameters
    ----------
    opened
        The scene: its heading stands above, its sentence, source and inferred parts below.
    height_mm
        Height of the drawing alone.
    note
        Further note on the drawing; "": none.
    maps
        Whether it shows maps, so that conditions of the measurement that concern maps are named.

    Attributes
    ----------
    figure
        The figure of matplotlib.
    """

    def __init__(
        self, opened: OpenedScene, height_mm: float, note: str = "", *, maps: bool = False
    ) -> None:
        self.maps = maps
        lines = _footer(opened, note, broken_conditions_text(opened, maps=maps))
        self._foot_mm = _LINE_MM * len(lines) + 2 * _FOOT_EDGE_MM
        self._height_mm = height_mm + _HEAD_MM + self._foot_mm
        self.figure = new_figure(WIDTH_MM, self._height_mm)
        with style():
            self._write(self._height_mm - 6.0, opened.scene.heading, INK, 9.0, "bold")
            for k, (line, colour) in enumerate(lines):
                y_mm = self._foot_mm - _FOOT_EDGE_MM - _LINE_MM * (k + 1)
                self._write(y_mm, line, colour, 6.5)

    def axes(self, x_mm: float, y_mm: float, width_mm: float, height_mm: float) -> Any:
        """Return axes at a position in the drawing, measured from its lower left corner."""
        height = self._height_mm
        return self.figure.add_axes(
            (
                x_mm / WIDTH_MM,
                (y_mm + self._foot_mm) / height,
                width_mm / WIDTH_MM,
                height_mm / height,
            )
        )

    def picture_inches(self) -> tuple[float, float, float, float]:
        """Return the corners of the drawing without heading and notes, in inches."""
        low, high = self._foot_mm, self._height_mm - _HEAD_MM + 1.0
        return 0.0, low / MM_PER_INCH, WIDTH_MM / MM_PER_INCH, high / MM_PER_INCH

    def row_of_axes(
        self, n: int, x_mm: float, y_mm: float, width_mm: float, height_mm: float
    ) -> list[Any]:
        """Return ``n`` axes side by side that fill an area."""
        each = width_mm / n
        return [self.axes(x_mm + k * each, y_mm, each - 1.0, height_mm) for k in range(n)]

    def colour_bar(
        self, image: Any, x_mm: float, y_mm: float, height_mm: float, label: str
    ) -> None:
        """Draw a colour bar 2.5 mm wide."""
        bar = self.figure.colorbar(image, cax=self.axes(x_mm, y_mm, 2.5, height_mm))
        bar.set_label(label)
        bar.outline.set_linewidth(0.4)

    def _write(
        self, y_mm: float, text: str, colour: str, size: float, weight: str = "normal"
    ) -> None:
        x, y = _EDGE_MM / WIDTH_MM, y_mm / self._height_mm
        self.figure.text(x, y, text, color=colour, fontsize=size, fontweight=weight)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Drawn:
    """A figure and its numbers.

    Attributes
    ----------
    sheet
        Page of the figure.
    tables
        Tables by the suffix of the name of their file, which is empty for the first one: the
        numbers of each column, (n_rows,), by its name, with its unit.
    """

    sheet: Sheet
    tables: dict[str, dict[str, Floats]]

    @property
    def figure(self) -> Any:
        """The figure of matplotlib."""
        return self.sheet.figure


def _footer(opened: OpenedScene, note: str, broken: str) -> list[tuple[str, str]]:
    """Return the lines below a drawing, each with its colour.

    ``broken``: the conditions of the measurement that are not met.
    """
    scene = opened.scene
    notes = [(scene.sentence, INK), (f"After {scene.source}.", DIM)]
    if scene.inferred:
        notes.append((sentence(f"Inferred: {'; '.join(scene.inferred)}"), DIM))
    notes += [(text, DIM) for text in (setup_text(opened), broken, note) if text]
    if opened.chosen:
        notes.append((opened.chosen, INK))
    if opened.synthetic:
        notes.append((f"{SYNTHETIC}; they may not show what the sentence says.", "#B00020"))
    return [
        (line, colour) for text, colour in notes for line in textwrap.wrap(text, _LINE_CHARACTERS)
    ]


_SHOWN_BANDS_HZ = (50.0, 100.0, 200.0, 400.0)
#: Mean of the adjusted R² that the paper measured.
MEASURED_R2 = 0.99
# An error of 0 is drawn here.
_SMALLEST = 1e-17
_CYCLES_SHOWN = 4.0


def _traces_of_designs(opened: OpenedScene) -> tuple[Floats, Floats]:
    """Return times and signals of the outputs, (n_designs, n_outputs, n_times), with the delay."""
    view = replace(opened.view, delay_removed=False)
    results = [
        evaluate(condition.design, "response_time_s", "selected_traces", view=view)
        for condition in opened.conditions
    ]
    return results[0]["response_time_s"], np.stack([each["selected_traces"] for each in results])


def strengths(opened: OpenedScene) -> Drawn:
    """Draw each tone at five strengths, divided by them, over each other."""
    view = opened.view
    time_s, curves = _traces_of_designs(opened)
    factors = np.array([condition.design.inputs[0].amplitude for condition in opened.conditions])
    normalised = curves / factors[:, None, None]
    drawn_s, drawn = finer(_from_pulse(opened, time_s), normalised)
    clips = opened.design.inputs[0].clips
    sheet, columns = Sheet(opened, 78.0), {"time_s": time_s}
    with style():
        for row, number in enumerate(view.outputs):
            for column, clip in enumerate(clips):
                ax = sheet.axes(22.0 + 52.0 * column, 46.0 - 34.0 * row, 46.0, 24.0)
                middle = clip.onset_s + clip.duration_s / 2.0
                half = _CYCLES_SHOWN / (2.0 * frequency_of(clip))
                within = np.abs(drawn_s - middle) <= half
                _overlay(ax, opened, 1e3 * drawn_s[within], drawn[:, row, within])
                ax.set_title(f"{frequency_of(clip):g} Hz: {ax.get_title()}", fontsize=6)
                ax.set_ylabel("" if column else f"Output {number}\nz / strength")
                ax.set_xlabel("" if row + 1 < len(view.outputs) else "Time (ms)")
            per = f"output_{number} per {amplitude_unit(opened.design)}"
            for condition, traces_of_design in zip(opened.conditions, normalised, strict=True):
                columns[f"{per} at {condition.label}"] = traces_of_design[row]
        handles = ax.get_legend_handles_labels()
        sheet.figure.legend(*handles, loc="upper right", ncols=5, fontsize=6)
    return Drawn(sheet=sheet, tables={"": columns})


def _overlay(ax: Any, opened: OpenedScene, time_ms: Floats, curves: Floats) -> None:
    for k, curve in enumerate(curves):
        # Each curve is thinner than the one before, so that all are visible.
        width, label = 4.5 - 0.95 * k, opened.conditions[k].label
        ax.plot(time_ms, curve, color=COLOURS[k], lw=width, label=label)
    largest = float(np.ptp(curves, axis=0).max()) / float(np.abs(curves).max())
    ax.set_title(f"differences up to {largest:.0e} of the peak" if largest else "no difference")
    ax.set_yticks([])
    ax.locator_params(axis="x", nbins=4)


@dataclass(frozen=True, slots=True, eq=False)
class Fits:
    """Straight lines of output over input, in bands of 2 Hz.

    Attributes
    ----------
    frequency_hz : (n_bands,)
        Middles of the bands.
    input_rms : (n_levels, n_bands)
        RMS of the input in each band.
    output_rms : (n_levels, n_channels, n_bands)
        RMS of the outputs in each band.
    slope, offset, adjusted_r2 : (n_channels, n_bands)
        Of the lines.
    """

    frequency_hz: Floats
    input_rms: Floats
    output_rms: Floats
    slope: Floats
    offset: Floats
    adjusted_r2: Floats


def swept_hz(opened: OpenedScene) -> Band:
    """Return the range of the sweep of a scene within the measured band of its limb.

    Raises
    ------
    InvalidInputError
        The two have no frequencies in common.
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
    of_input, of_outputs, frequency_hz = [], [], np.zeros(0)
    for condition in opened.conditions:
        results = evaluate(condition.design, "input_waveforms", "sample_rate_hz")
        (waveform,) = results["input_waveforms"]
        _, field = field_of(condition.design)
        drive = waveform * condition.design.inputs[0].amplitude
        n_times = field.shape[-1]
        rate_hz = results["sample_rate_hz"]
        drive_spectrum = scipy.fft.rfft(drive, n_times)
        frequency_hz, drive_rms = band_rms(drive_spectrum, n_times, rate_hz, swept)
        of_input.append(drive_rms)
        output_spectra = scipy.fft.rfft(normal_of(condition.design, field))
        of_outputs.append(band_rms(output_spectra, n_times, rate_hz, swept)[1])
    x, y = np.stack(of_input), np.stack(of_outputs)
    return Fits(frequency_hz, x, y, *straight_lines(x[:, None], y))


def output_over_input(opened: OpenedScene) -> Drawn:
    """Draw output over input in some bands, with their lines."""
    fits, outputs, unit = lines_of(opened), opened.view.outputs, amplitude_unit(opened.design)
    sheet = Sheet(opened, 70.0)
    bands = [int(np.argmin(np.abs(fits.frequency_hz - band_hz))) for band_hz in _SHOWN_BANDS_HZ]
    with style():
        for k, number in enumerate(outputs):
            ax = sheet.axes(22.0 + 84.0 * k, 12.0, 66.0, 50.0)
            for colour, marker, band in zip(COLOURS, "os^D", bands, strict=False):
                x = fits.input_rms[:, band]
                line = fits.slope[number - 1, band] * x + fits.offset[number - 1, band]
                r2 = fits.adjusted_r2[number - 1, band]
                label = f"{fits.frequency_hz[band]:.0f} Hz, adjusted R² {r2:.6f}"
                ax.loglog(x, line, color=colour, lw=0.8)
                y = fits.output_rms[:, number - 1, band]
                ax.loglog(x, y, marker, ms=4, mfc="none", color=colour, label=label)
            ax.set_title(f"Output {number}, z")
            ticks = fits.input_rms[:, bands[0]]
            ax.set_xticks(ticks, [f"{tick:.2g}" for tick in ticks])
            ax.minorticks_off()
            ax.set_xlabel(f"Input in the band ({unit})")
            ax.set_ylabel("Output in the band (m/s²)")
            ax.legend(fontsize=6, loc="upper left")
            low, high = ax.get_ylim()
            ax.set_ylim(low, high * 12.0)
    columns = {"frequency_hz": fits.frequency_hz}
    for level, label in enumerate(opened.scene.labels):
        columns[f"input at {label} ({unit})"] = fits.input_rms[level]
        for number in outputs:
            columns[f"output_{number} at {label} (m/s²)"] = fits.output_rms[level, number - 1]
    return Drawn(sheet=sheet, tables={"": columns})


def straightness(opened: OpenedScene) -> Drawn:
    """Draw the adjusted R² of the worst output, and the median of all outputs."""
    fits = lines_of(opened)
    deviation = float(1.0 - fits.adjusted_r2.min())
    sheet = Sheet(opened, 62.0)
    with style():
        ax = sheet.axes(26.0, 12.0, 146.0, 44.0)
        for label, values, colour, width in (
            ("worst output", fits.adjusted_r2.min(axis=0), COLOURS[1], 2.5),
            ("median of all outputs", np.median(fits.adjusted_r2, axis=0), COLOURS[0], 0.8),
        ):
            ax.plot(fits.frequency_hz, values, color=colour, lw=width, label=label)
        low_hz, high_hz = swept_hz(opened)
        ax.axhline(MEASURED_R2, color=DIM, lw=0.8, ls="--")
        ax.text(low_hz, MEASURED_R2, f" {MEASURED_R2}: mean of the paper", va="bottom", color=DIM)
        ax.set_xlim(low_hz, high_hz)
        ax.set_ylim(min(0.985, 1.0 - 1.2 * deviation), 1.001)
        ax.set_xlabel("Frequency (Hz)")
        ax.set_ylabel("Adjusted R²")
        ax.legend(loc="lower right", ncols=2)
        bound = f"1 − adjusted R² is at most {deviation:.0e}"
        note = bound if deviation > 0.0 else "1 to the last digit"
        ax.text(0.02, 0.06, note, transform=ax.transAxes)
    columns = {"frequency_hz": fits.frequency_hz}
    for number, adjusted_r2 in enumerate(fits.adjusted_r2, start=1):
        columns[f"output_{number}_adjusted_r2"] = adjusted_r2
    return Drawn(sheet=sheet, tables={"": columns})


def superposition(opened: OpenedScene) -> Drawn:
    """Draw the sum of the responses to each input, the response to both, and their correlation."""
    fields = [field_of(condition.design) for condition in opened.conditions]
    time_s, joint = fields[-1]
    separate = fields[0][1] + fields[1][1]
    worst = pearson(separate, joint).min(axis=1)
    outputs, columns = opened.view.outputs, {"time_s": time_s}
    normal = normal_of(opened.design, separate), normal_of(opened.design, joint)
    sheet = Sheet(opened, 70.0)
    with style():
        _draw_sums(sheet, outputs, _from_pulse(opened, time_s), *normal)
        ax = sheet.axes(112.0, 12.0, 62.0, 46.0)
        numbers = np.arange(1.0, worst.size + 1.0)
        ax.semilogy(numbers, np.maximum(1.0 - worst, _SMALLEST), "o", ms=2.5, color=COLOURS[0])
        ax.set_ylim(_SMALLEST, 1.0)
        ax.axhline(0.01, color=COLOURS[1], lw=0.8)
        ax.text(
            1.0,
            0.013,
            "r = 0.99; the paper measured more",
            color=COLOURS[1],
            fontsize=6,
            va="bottom",
        )
        ax.set_xlabel("Output")
        ax.set_ylabel("1 − Pearson r, worst axis")
        ax.set_title("0 is drawn at the foot", fontsize=6)
    for number in outputs:
        for name, signals in zip(("separate", "joint"), normal, strict=True):
            columns[f"output_{number}_z_{name}_m_per_s2"] = signals[number - 1]
    correlation = {"output": numbers, "pearson_r": worst}
    return Drawn(sheet=sheet, tables={"": columns, "-correlation": correlation})


def _draw_sums(
    sheet: Sheet, outputs: Sequence[int], time_s: Floats, separate: Floats, joint: Floats
) -> None:
    """Draw some cycles in the middle of the sweep, along the axis normal to the skin."""
    chosen = np.array(outputs) - 1
    drawn_s, (drawn_separate, drawn_joint) = finer(time_s, np.stack((separate, joint))[:, chosen])
    within = (drawn_s > 0.95) & (drawn_s < 1.0)
    for k, number in enumerate(outputs):
        ax = sheet.axes(26.0, 40.0 - 28.0 * k, 66.0, 20.0)
        ax.plot(
            1e3 * drawn_s[within],
            drawn_separate[k, within],
            color=COLOURS[5],
            lw=3.0,
            label="sum of separate",
        )
        ax.plot(1e3 * drawn_s[within], drawn_joint[k, within], color=INK, lw=0.8, label="joint")
        ax.set_ylabel(f"Output {number}\nz (m/s²)")
        if k == 0:
            ax.legend(fontsize=6, loc="lower right", bbox_to_anchor=(1.0, 0.98), ncols=2)
    ax.set_xlabel("Time (ms)")


_HEIGHT_MM, _BAR_ROOM_MM = 92.0, 20.0
_RELATIVE_RANGE_DB = (-MAP_RANGE_DB, 0.0)


def maps_of_designs(opened: OpenedScene, *, own_scale: bool) -> Drawn:
    """Draw a map for each design, all in one scale of levels or each re its loudest output."""
    levels = [levels_of(condition.design, None, opened.view) for condition in opened.conditions]
    if not own_scale:
        colours = common_range(*(level.values for level in levels))
        return maps_figure(opened, levels, opened.scene.labels, colours, "dB re 1 m/s²")
    tops_db = [float(level.values.max()) for level in levels]
    unit = "dB re the loudest output of each"
    return maps_figure(opened, levels, opened.scene.labels, _RELATIVE_RANGE_DB, unit, tops_db)


def maps_of_axes(opened: OpenedScene) -> Drawn:
    """Draw a map for each axis, all re the loudest output on any axis."""
    single = axes_of_sensors(opened.design)
    levels = [levels_of(opened.design, None, replace(opened.view, axes=axis)) for axis in single]
    titles = [f"Along {axis}" for axis in single]
    tops_db = [max(float(level.values.max()) for level in levels)] * len(levels)
    unit = "dB re the loudest output on any axis"
    return maps_figure(opened, levels, titles, _RELATIVE_RANGE_DB, unit, tops_db)


def maps_figure(
    opened: OpenedScene,
    levels: Sequence[Levels],
    titles: Sequence[str],
    colours: Range,
    unit: str,
    tops_db: Sequence[float] = (),
) -> Drawn:
    """Draw maps side by side with one colour bar, and make a table of the levels.

    ``tops_db``: reference level of each map; 0 dB unless given.
    """
    tops_db = tops_db or [0.0] * len(levels)
    noisy = any(level.noisy for level in levels)
    sheet = Sheet(opened, _HEIGHT_MM, f"{HATCHED}." if noisy else "", maps=True)
    room_mm = min(WIDTH_MM - _BAR_ROOM_MM - 6.0, 50.0 * len(levels))
    left_mm = (WIDTH_MM - _BAR_ROOM_MM - room_mm) / 2.0
    with style():
        places = sheet.row_of_axes(len(levels), left_mm, 2.0, room_mm, _HEIGHT_MM - 8.0)
        pairs = zip(levels, tops_db, strict=True)
        shown = [replace(level, values=level.values - top_db) for level, top_db in pairs]
        image = draw_maps(places, shown, colours, titles)
        sheet.colour_bar(image, left_mm + room_mm + 2.0, 24.0, 50.0, unit)
    columns = {"output": np.arange(1.0, levels[0].values.size + 1.0)}
    for level, top_db, title in zip(levels, tops_db, titles, strict=True):
        columns[f"{title.replace(',', '')} ({unit})"] = levels_for_tables(level.values) - top_db
    return Drawn(sheet=sheet, tables={"": columns})


# Time of the first frame after the pre-trigger delay: 100 ms on the published limbs.
_N_FRAMES, _FIRST_FRAME_S = 5, 0.048
# Colours end at this share of the peak: on a scale up to the peak only the finger is visible.
_SHARE_OF_PEAK = 0.1


def tone_frames(opened: OpenedScene) -> Drawn:
    """Draw the signed acceleration normal to the skin at steps of a quarter of a cycle."""
    (clip,) = opened.design.clips
    time_s, field = field_of(opened.design)
    rate_hz = 1.0 / (time_s[1] - time_s[0])
    first_s = facts_of(opened.design.limb).pre_trigger_delay_s + _FIRST_FRAME_S
    quarters = first_s + np.arange(_N_FRAMES) / (4.0 * frequency_of(clip))
    along_z = normal_of(opened.design, field)
    normal = np.array([values_at(along_z, (at_s - time_s[0]) * rate_hz) for at_s in quarters])
    limit = _SHARE_OF_PEAK * float(np.abs(along_z).max())
    sheet = Sheet(opened, 84.0, maps=True)
    with style():
        places = sheet.row_of_axes(_N_FRAMES, 4.0, 2.0, 146.0, 76.0)
        shown = [levels_of_values(opened.design, values) for values in normal]
        titles = _instant_titles(_from_pulse(opened, quarters))
        image = draw_maps(places, shown, (-limit, limit), titles, signed=True)
        label = f"z, m/s²; colours end at {_SHARE_OF_PEAK:.0%} of the peak"
        sheet.colour_bar(image, 153.0, 20.0, 48.0, label)
    columns = {"output": np.arange(1.0, normal.shape[1] + 1.0)}
    for at_s, values in zip(quarters, normal, strict=True):
        columns[f"z at {1e3 * at_s:.3f} ms (m/s²)"] = values
    return Drawn(sheet=sheet, tables={"": columns})


def _from_pulse(opened: OpenedScene, time_s: Floats) -> Floats:
    """Return times of records as they are drawn: 0 is the pulse; tables keep the record."""
    return time_s - facts_of(opened.design.limb).pre_trigger_delay_s


def _instant_titles(time_s: Floats) -> list[str]:
    return [f"{1e3 * instant_s:.1f} ms" for instant_s in time_s]


# Of each design: its train, maps of its windows, and their extents.
_BLOCK_MM = 108.0


def train_windows(opened: OpenedScene) -> Drawn:
    """Draw each train, maps of its windows re the loudest output of each, and their extents."""
    window_s, designs = opened.view.window_s, [each.design for each in opened.conditions]
    shown = [
        windowed_levels(design, opened.view, count=None, window_s=window_s) for design in designs
    ]
    noisy = any(any(windowed.noisy_outputs_of_windows) for windowed in shown)
    note = f"{HATCHED}." if noisy else ""
    sheet = Sheet(opened, _BLOCK_MM * len(shown), note, maps=True)
    left_mm, width_mm = 22.0, WIDTH_MM - 48.0
    tables: dict[str, dict[str, Floats]] = {}
    with style():
        for k, (condition, windowed) in enumerate(zip(opened.conditions, shown, strict=True)):
            n, bottom_mm = windowed.windows.count, _BLOCK_MM * (len(shown) - 1 - k)
            train = sheet.axes(left_mm, bottom_mm + 94.0, width_mm, 12.0)
            _draw_stimulus(train, condition, n * window_s)
            places = sheet.row_of_axes(n, left_mm, bottom_mm + 28.0, width_mm, 62.0)
            levels, titles = windowed.maps(n)
            levels = [replace(each, values=each.values - each.values.max()) for each in levels]
            image = draw_maps(places, levels, _RELATIVE_RANGE_DB, titles)
            bar = left_mm + width_mm + 2.0, bottom_mm + 36.0, 44.0
            sheet.colour_bar(image, *bar, "dB re the loudest output of each")
            draw_extent(sheet.axes(left_mm, bottom_mm + 5.0, width_mm, 16.0), windowed, n)
            bounds_s = windowed.windows.bounds_s(windowed.sample_rate_hz)
            header, rows = windows_table(
                bounds_s, windowed.extents_of_windows, windowed.rms_of_windows
            )
            suffix = f"-{condition.label.lower()}" if k else ""
            tables[suffix] = dict(zip(header, np.transpose(rows), strict=True))
    return Drawn(sheet=sheet, tables=tables)


def _draw_stimulus(ax: Any, condition: Condition, until_s: float) -> None:
    results = evaluate(condition.design, "input_waveforms", "sample_rate_hz")
    (waveform,) = results["input_waveforms"]
    ax.plot(np.arange(waveform.size) / results["sample_rate_hz"], waveform, color=INK, lw=0.7)
    ax.set_xlim(0.0, until_s)
    ax.set_axis_off()
    ax.annotate(
        condition.label or "Input",
        (0.0, 0.5),
        xycoords="axes fraction",
        xytext=(-8, 0),
        ha="right",
        va="center",
        textcoords="offset points",
    )


_ROW_MM, _AXIS_MM = 11.0, 12.0
_LEFT_MM, _RIGHT_MM = 34.0, 8.0
_FRAMES_MM = 54.0
_RED_BLUE_BLACK = (COLOURS[1], COLOURS[0], COLOURS[2])
# How long after the pulse the paper shows it: at 52.0, 52.75, 53.5, 54.25 and 55.0 ms.
_INSTANTS_S = (0.0, 0.00075, 0.0015, 0.00225, 0.003)


def pulse_traces(opened: OpenedScene) -> Drawn:
    """Draw the axes of each output, relative to its peak, and maps of the first 3 ms."""
    outputs, axes = opened.view.outputs, axes_of_sensors(opened.design)
    time_s, field = field_of(opened.design)
    within = _in_time_range(opened, _from_pulse(opened, time_s))
    drawn_s, drawn = finer(_from_pulse(opened, time_s), field[np.array(outputs) - 1])
    drawn_within = _in_time_range(opened, drawn_s)
    rows = [
        _row(number, 1e3 * drawn_s[drawn_within], curves[:, drawn_within])
        for number, curves in zip(outputs, drawn, strict=True)
    ]
    height_mm = 9.0 * len(rows)
    sheet = Sheet(opened, height_mm + _FRAMES_MM + 20.0, maps=True)
    facts = facts_of(opened.design.limb)
    rate_hz, delay_s = facts.sample_rate_hz, facts.pre_trigger_delay_s
    instants = [floor((delay_s + later_s) * rate_hz + NEAR) for later_s in _INSTANTS_S]
    magnitudes = magnitude(field)[:, instants].T
    levels = [levels_of_values(opened.design, decibels(each)) for each in magnitudes]
    with style():
        width_mm = WIDTH_MM - _LEFT_MM - _RIGHT_MM
        ax = sheet.axes(_LEFT_MM, _FRAMES_MM + 14.0, width_mm, height_mm)
        draw_rows(ax, rows, labels=axes)
        ax.set_xlabel("Time (ms)")
        annotate_scale(ax, "each row relative to its peak")
        colours = common_range(*(level.values for level in levels))
        places = sheet.row_of_axes(len(instants), 12.0, 1.0, 146.0, _FRAMES_MM - 6.0)
        titles = _instant_titles(_from_pulse(opened, time_s[instants]))
        image = draw_maps(places, levels, colours, titles, part="hand")
        sheet.colour_bar(image, 160.0, 4.0, _FRAMES_MM - 14.0, "magnitude, dB re 1 m/s²")
    shown = field[np.array(outputs) - 1][..., within]
    columns = {"time_s": time_s[within], **_columns_of_axes(outputs, axes, shown)}
    frames = {"output": np.arange(1.0, magnitudes.shape[1] + 1.0)}
    for instant, values in zip(instants, magnitudes, strict=True):
        frames[f"{1e3 * time_s[instant]:.3f}_ms_magnitude_m_per_s2"] = values
    return Drawn(sheet=sheet, tables={"": columns, "-frames": frames})


def _columns_of_axes(
    outputs: Sequence[int], axes: Sequence[str], values: Floats
) -> dict[str, Floats]:
    """Return values, (n_outputs, n_axes, n), by the names of their columns."""
    return {
        f"output_{number}_{axis}_m_per_s2": values[row, column]
        for row, number in enumerate(outputs)
        for column, axis in enumerate(axes)
    }


def traces(opened: OpenedScene, *, colours: Sequence[str], own_scale: bool) -> Drawn:
    """Draw outputs over time, all designs over each other.

    ``own_scale``: whether each row is relative to its peak; else all have one scale.
    """
    view, several = opened.view, len(opened.conditions) > 1
    time_s, curves = _traces_of_designs(opened)
    from_pulse_s = _from_pulse(opened, time_s)
    within = _in_time_range(opened, from_pulse_s)
    drawn_s, drawn = finer(from_pulse_s, curves)
    shown = _in_time_range(opened, drawn_s)
    drawn_s, drawn = drawn_s[shown], drawn[..., shown]
    size = None if own_scale else common_size(list(drawn))
    rows = [_row(number, 1e3 * drawn_s, drawn[:, k], size) for k, number in enumerate(view.outputs)]
    labels = opened.scene.labels if several else ()
    sheet, ax = _rows_sheet(opened, rows, labels, colours)
    with style():
        ax.set_xlabel("Time (ms)")
        scale = "each row relative to its peak" if own_scale else f"a row is {size:.3g} m/s² high"
        annotate_scale(ax, f"{signal_label(view.axes, view.method)}; {scale}")
    columns = {"time_s": time_s[within]}
    for label, curves_of_design in zip(opened.scene.labels, curves[..., within], strict=True):
        name = f"_{label.replace(' ', '_')}" if several else ""
        for number, curve in zip(view.outputs, curves_of_design, strict=True):
            columns[f"output_{number}{name}_m_per_s2"] = curve
    return Drawn(sheet=sheet, tables={"": columns})


def axis_spectra(opened: OpenedScene, n_bins: int = 1, axes: Sequence[Axes] = ()) -> Drawn:
    """Draw spectra of the axes of each output, relative to its peak, as means of ``n_bins``.

    ``axes``: all that the sensors have unless given.
    """
    outputs, axes = opened.view.outputs, axes or axes_of_sensors(opened.design)
    by_axis, frequency_hz = [], np.zeros(0)
    for axis in axes:
        view = replace(opened.view, axes=axis)
        spectra = evaluate(opened.design, "selected_spectra", view=view)["selected_spectra"]
        frequency_hz, of_axis = spectra
        by_axis.append(mean_of_bins(of_axis, n_bins))
    low_hz, high_hz = facts_of(opened.design.limb).band_hz or (0.0, np.inf)
    within = (frequency_hz >= low_hz) & (frequency_hz <= high_hz)
    of_outputs = np.stack(by_axis, axis=1)[..., within]
    rows = [
        _row(number, frequency_hz[within], magnitudes)
        for number, magnitudes in zip(outputs, of_outputs, strict=True)
    ]
    sheet, ax = _rows_sheet(opened, rows, axes, COLOURS, from_zero=True)
    with style():
        ax.set_xlabel("Frequency (Hz)")
        mean = f", mean of {n_bins} bins" if n_bins > 1 else ""
        annotate_scale(ax, f"magnitude{mean}; each row relative to its largest")
    columns = _columns_of_axes(outputs, axes, of_outputs)
    return Drawn(sheet=sheet, tables={"": {"frequency_hz": frequency_hz[within], **columns}})


def _rows_sheet(
    opened: OpenedScene,
    rows: Sequence[PlotRow],
    labels: Sequence[str],
    colours: Sequence[str],
    *,
    from_zero: bool = False,
) -> tuple[Sheet, Any]:
    height_mm = _ROW_MM * len(rows) + _AXIS_MM + 8.0
    sheet = Sheet(opened, height_mm)
    with style():
        ax = sheet.axes(
            _LEFT_MM, _AXIS_MM, WIDTH_MM - _LEFT_MM - _RIGHT_MM, height_mm - _AXIS_MM - 8.0
        )
        draw_rows(ax, rows, labels=labels, colours=colours, from_zero=from_zero)
    return sheet, ax


def _row(number: int, x: Floats, curves: Floats, size: float | None = None) -> PlotRow:
    peak = float(np.abs(curves).max(initial=0.0))
    label = f"Output {number}" if size is not None else f"Output {number}\n{peak:.2g} m/s²"
    return PlotRow(label=label, x=x, curves=curves, unit_size=size)


def _in_time_range(opened: OpenedScene, time_s: Floats) -> Any:
    low, high = opened.view.time_range_s or (float(time_s[0]), float(time_s[-1]))
    return (time_s >= low) & (time_s <= high)


_OWN_TRACES = partial(traces, colours=(COLOURS[2],), own_scale=True)
_MAPS, _RELATIVE_MAPS = (partial(maps_of_designs, own_scale=own) for own in (False, True))
#: The function that draws the figure of a scene, by the name of the scene.
FIGURES: dict[str, Callable[[OpenedScene], Drawn]] = {
    "1C": pulse_traces,
    "1D": axis_spectra,
    "1E": maps_of_axes,
    "1F": _RELATIVE_MAPS,
    "1G": _RELATIVE_MAPS,
    "2A": _OWN_TRACES,
    "2B": _MAPS,
    "2C": _OWN_TRACES,
    "2D": partial(axis_spectra, n_bins=MEAN_OF_BINS),
    "2E": _MAPS,
    "2F": partial(traces, colours=_RED_BLUE_BLACK, own_scale=False),
    "2H": train_windows,
    "4A": tone_frames,
    "4B": _OWN_TRACES,
    "5B": strengths,
    "5B-2": strengths,
    "5D": output_over_input,
    "5E": straightness,
    "5F": superposition,
    "I1": _RELATIVE_MAPS,
    "I2": partial(axis_spectra, axes=("z",)),
    "I3": partial(traces, colours=_RED_BLUE_BLACK, own_scale=False),
    "I4": _RELATIVE_MAPS,
    "I5": _RELATIVE_MAPS,
}
