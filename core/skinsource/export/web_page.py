"""A design as one web page: its map in motion, levels, traces, timeline, snapshots and drive.

The page is opened from disk, asks nothing of the network, and computes no prediction: it shows what
is embedded.  A browser of 2023 or later is needed, for ``DecompressionStream``.

What is passed on depends on whose responses they are.  Of a synthetic limb, the field that the map
shows is embedded with its sign in 16 bits.  The field of one impulse is the response itself, which
of a measured limb, published or own, is not ours to pass on: so of these the lengths of vectors are
embedded, in 8 bits, and of traces their peaks in pieces of at least 10 ms.  The published map is
not passed on either: the published limbs are drawn on a hand of this project, which has the same
places.
"""

import base64
import hashlib
import json
import re
import zlib
from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from math import ceil, floor, inf
from pathlib import Path

import numpy as np
import scipy
from numpy.typing import NDArray

from skinsource.base.arguments import checking
from skinsource.base.assets import data_folder
from skinsource.base.conventions import Floats
from skinsource.base.decibels import FLOOR_DB
from skinsource.base.errors import InvalidInputError, SkinSourceError, counted, printable
from skinsource.base.files import FilePath
from skinsource.base.job import Progress, Stop, never, silent
from skinsource.base.json_text import Tree
from skinsource.design.amplitudes import amplitude_text
from skinsource.design.comparing import frequency_of, own_parts, snapshot_name, with_edited
from skinsource.design.describing import clips_text
from skinsource.design.design import (
    Design,
    Input,
    Snapshot,
    View,
    audible_inputs,
    shown_snapshot,
    view_on,
)
from skinsource.design.labels import level_label, limb_label, signal_label
from skinsource.engine.loops import animation_of, moving_name
from skinsource.engine.time_rules import BLOCK_S, Moving, block_of
from skinsource.export.exported_design import (
    Export,
    ExportedDesign,
    about,
    clip_description,
    output_file,
)
from skinsource.export.packing import citation
from skinsource.export.plot import (
    HATCHED,
    NOISE_REACH,
    SHARE_OF_LARGEST,
    common_range,
    least_slow_motion,
    levels_of,
)
from skinsource.limbs.catalog import load_limb
from skinsource.limbs.limb import Limb
from skinsource.limbs.locations import input_name, output_name
from skinsource.limbs.own_limbs import axes_on
from skinsource.limbs.surface.operator import SurfaceOperator
from skinsource.limbs.surface.surface import cached_surface_operator
from skinsource.perception.validity import Judged, in_short, noisy_outputs
from skinsource.signals.projection import magnitude
from skinsource.signals.resampling import by_ratio
from skinsource.signals.sampling import REACH

#: The first sample of an input, and its samples from there on, before its amplitude.
_Played = tuple[int, Floats]
#: Begin and end of what is shown, s.
_Times = tuple[float, float]

ENDING = ".html"
#: The most bytes of a field before it is deflated.
MOST_BYTES = 4_000_000
_FRAMES_PER_S = 60
_SPEEDS = (20.0, 50.0, 100.0, 200.0, 500.0, 1000.0)
# Squares of band-limited signals have twice their band.
_FINER = 2
_MOST_PIXELS, _MOST_POINTS, _MOST_TRACES = 10_000, 600, 8
_BESIDE = 2.5
# Peaks of shorter pieces would follow the wave.
_LEAST_PIECE_S = 0.01
# Buffers of sound have this rate at least.
_SOUND_HZ, _OCTAVES_UP = 8000.0, 2


@checking
def export_page(
    design: Design,
    path: FilePath,
    *,
    view: View | None = None,
    progress: Progress = silent,
    stop: Stop = never,
) -> Path:
    """Write a design as a web page, one file that any browser of 2023 or later shows.

    It has the skin map in motion and its levels, the traces of the selected outputs, the timeline,
    snapshots side by side, and the drive as sound.  See `skinsource.export.web_page` for what of a
    measured limb is passed on.

    Parameters
    ----------
    design
        What is played.
    path
        The file; its name ends in ``.html``.
    view
        Axes, method and span of levels, selected outputs, snapshots, and range of times;
        ``View()`` unless given.
    progress, stop
        Called with the progress; asked whether to stop.

    Returns
    -------
    The path.

    Raises
    ------
    InvalidInputError
        The ending is another one, an input cannot be played, or the range of times is too long.
    StorageError, Stopped
        It cannot be written; ``stop`` said so.  Nothing is left then.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> import skinsource as ss
    >>> tone = ss.track(7, ss.waveforms.Tone(frequency_hz=100.0))
    >>> design = ss.Design(limb="synthetic-1", inputs=(tone,), title="A tone")
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     print(ss.export_page(design, Path(folder) / "tone.html").stat().st_size < 1_000_000)
    True
    """
    target, view = Path(path), view_on(design.limb, view or View())
    write_page(target, ExportedDesign(design, view, progress, stop))
    return target


def write_page(path: Path, exported: ExportedDesign) -> None:
    """Write a page that shows a design and asks nothing of the network."""
    if path.suffix.lower() != ENDING:
        raise InvalidInputError(
            f"{printable(path.name)} is not the name of a web page. Call it *{ENDING}."
        )
    content = page_of(page_content(exported)).encode()
    with output_file(path, exported.stop) as file:
        file.write(content)
        exported.progress(1, 1, "Writing")


#: The same as an entry of the export dialog.
export_web_page = Export(write_page)


def page_of(content: Tree) -> str:
    """Return the page that shows a content; nothing in it can be taken for markup."""
    folder = data_folder() / "web_page"
    parts = {name: (folder / f"page.{name}").read_text("utf-8") for name in ("html", "css", "js")}
    rules = (
        "default-src 'none'",
        f"script-src {_allowed(parts['js'])}",
        f"style-src {_allowed(parts['css'])}",
        "img-src data:",
        "base-uri 'none'",
    )
    fields = {
        "policy": "; ".join(rules),
        "style": parts["css"],
        "script": parts["js"],
        # Within a script no other sign begins a tag.
        "data": json.dumps(content, allow_nan=False).replace("<", "\\u003c"),
    }
    return re.sub(r"\{\{(\w+)\}\}", lambda field: fields[field[1]], parts["html"])


def content_of(page: str) -> Tree:
    """Return the content that a page shows."""
    _, _, after = page.partition('type="application/json">')
    return json.loads(after.partition("<")[0])


def _allowed(text: str) -> str:
    digest = hashlib.sha256(text.encode()).digest()
    return f"'sha256-{base64.b64encode(digest).decode()}'"


def page_content(exported: ExportedDesign) -> Tree:
    """Return what a page shows: texts, numbers, and arrays as deflated bytes in base64.

    Levels are hundredths of a decibel.
    """
    design, view, limb = exported.design, exported.view, exported.limb
    values = exported.values({"output_levels_db", "output_rms", "validity"})
    times, played = _times(exported), _played(exported)
    maps: dict[str, Tree] = {design.limb: _map_of(limb, exported.value("surface"))}
    levels_db = values["output_levels_db"]
    snapshots = _snapshots(exported, maps)
    shown_db = [levels_db, *(np.array(s["levels"]) / 100 for s in snapshots if s.get("levels"))]
    field = _field(exported, times)
    exported.progress(0, 0, "Computing")
    label = f"{level_label(view.span)}; {signal_label(view.axes, view.method)}"
    outputs = view.outputs[:_MOST_TRACES]
    inputs = sorted({track.location for track in audible_inputs(design.inputs)})
    return {
        "title": design.title,
        "notes": design.notes,
        "about": _about(limb, inputs),
        "synthetic": limb.synthetic,
        "cautions": in_short([Judged(label="", note=limb.note, findings=values["validity"])]),
        "details": [
            *about(exported, label),
            exported.loudest_error_line(values["output_rms"]),
            f"in this page: {_passed_on(limb)}",
        ],
        "citation": citation(design).splitlines(),
        "first_s": times[0],
        "last_s": times[1],
        "field": field,
        **_motion(exported, times, signed=field["signed"]),
        "levels": _hundredths(levels_db),
        "levels_label": label,
        "range_db": common_range(*shown_db),
        "names": [output_name(number, design.limb).name for number in exported.all_outputs],
        "noisy": noisy_outputs(values["validity"]),
        "hatched": f"{HATCHED}.",
        "outputs": outputs,
        "inputs": inputs,
        "maps": list(maps.values()),
        "traces": _traces(exported, outputs, times),
        "traces_about": _about_traces(limb, view),
        "tracks": [
            _track(exported, track, each, times)
            for track, each in zip(design.inputs, played, strict=True)
        ],
        "snapshots": snapshots,
        "sound": _sound(exported, played, times),
    }


def _played(exported: ExportedDesign) -> list[_Played]:
    values = exported.values({"voices", "input_waveforms"})
    nothing = np.zeros(0)
    return [
        # A muted input that cannot be played has no samples.
        (voice.start, nothing if samples is None else samples)
        for voice, samples in zip(values["voices"], values["input_waveforms"], strict=True)
    ]


def _times(exported: ExportedDesign) -> _Times:
    """Return begin and end of what is shown; 0 is when the pulse of the measurement is played."""
    view, limb = exported.view, exported.limb
    time_s: Floats = exported.value("response_time_s", delay_removed=True)
    removed_s = 0.0 if view.delay_removed else limb.pre_trigger_delay_s
    chosen = view.time_range_s or (0.0, float(time_s[-1]) + removed_s)
    last_s = min(chosen[1] - removed_s, float(time_s[-1]))
    first_s = max(min(chosen[0] - removed_s, last_s), 0.0)
    bytes_per_s = exported.limb.n_outputs * exported.sample_rate_hz * 2
    longest_s = min(BLOCK_S, MOST_BYTES / bytes_per_s)
    if not 0.0 < last_s - first_s <= longest_s:
        raise InvalidInputError(
            f"the page would show {first_s:g} to {last_s:g} s, expected up to {longest_s:.3g} s. "
            "Zoom the time axes to a part, or choose time_range_s of the view."
        )
    return first_s, last_s


def _packed(array: NDArray[np.generic]) -> str:
    """Return an array as deflated bytes in base64; its numbers are little-endian already."""
    return base64.b64encode(zlib.compress(np.ascontiguousarray(array).tobytes(), 9)).decode()


def _hundredths(levels_db: Floats) -> list[int]:
    return [round(100 * level) for level in np.maximum(levels_db, FLOOR_DB).tolist()]


def _rounded(points: Floats) -> list[list[float] | None]:
    """Return points in mm, to a tenth; None for those that have no place."""
    return [None if x != x else [round(x, 1), round(y, 1)] for x, y in points.tolist()]


# ---- the map ----


def _is_published(limb: Limb) -> bool:
    return limb.name.startswith("measured-")


def _map_of(limb: Limb, surface: SurfaceOperator) -> Tree:
    if _is_published(limb):
        drawn = load_limb(limb.name.replace("measured", "synthetic"))
        limb, surface = drawn, cached_surface_operator(drawn)
    step = ceil(np.sqrt(surface.mask.sum() / _MOST_PIXELS))
    mask = surface.mask[::step, ::step]
    # Pixels beside those inside are like the nearest one: the outline cuts through them.
    distance, (row, column) = scipy.ndimage.distance_transform_edt(~mask, return_indices=True)
    drawn_at = distance < _BESIDE
    numbers = np.arange(surface.mask.size).reshape(surface.mask.shape)[::step, ::step]
    pixels = numbers[row, column][drawn_at]
    weights = surface.weights[pixels]
    shares = np.rint(255 * weights.data).astype(np.uint8)
    # Each pixel keeps one weight at least: the largest of several is 1/255 or more of all.
    kept = shares > 0
    rows = np.repeat(np.arange(len(pixels)), np.diff(weights.indptr))[kept]
    mm = limb.hand_length_mm / limb.map.hand_length_px
    outline_mm = limb.map.outline * mm
    return {
        "rows": mask.shape[0],
        "columns": mask.shape[1],
        "x_mm": float(surface.x_mm[0]),
        "y_mm": float(surface.y_mm[0]),
        "step_mm": float(surface.x_mm[1] - surface.x_mm[0]) * step,
        "bounds_mm": [*outline_mm.min(axis=0).tolist(), *outline_mm.max(axis=0).tolist()],
        "outline_mm": _rounded(outline_mm),
        "inputs_mm": _rounded(limb.map.input_positions * mm),
        "outputs_mm": _rounded(limb.map.output_positions * mm),
        "noise_reach_mm": NOISE_REACH * limb.hand_length_mm,
        "inside": _packed(drawn_at.astype(np.uint8)),
        "counts": _packed(np.bincount(rows, minlength=len(pixels)).astype(np.uint8)),
        "outputs": _packed(weights.indices[kept].astype("<u2")),
        "weights": _packed(shares[kept]),
    }


# ---- what moves ----


def _field(exported: ExportedDesign, times: _Times) -> Tree:
    """Return the field around the times that are shown: along z of a computed limb, else lengths.

    Lengths are written as square roots, so that small ones keep more of their digits.
    """
    limb = exported.limb
    signed = limb.synthetic and "z" in limb.axes
    name = "moving_z" if signed else "moving_vector"
    moving: Moving = exported.value(name, moving_block=block_of(times[0]))
    rate_hz = moving.sample_rate_hz
    before_s = moving.delay_s
    first = max(floor((times[0] + before_s) * rate_hz) - REACH, moving.first)
    end = min(ceil((times[1] + before_s) * rate_hz) + REACH + 1, moving.end)
    signals = moving.signals[..., first - moving.first : end - moving.first]
    values = signals[:, 0] if signed else magnitude(by_ratio(signals, Fraction(_FINER), rate_hz))
    largest = float(np.abs(values).max(initial=0.0)) or 1.0
    share, limit = values / largest, (moving.largest or 1.0) * SHARE_OF_LARGEST
    return {
        "signed": signed,
        "quantity": "m/s² normal to the skin" if signed else "m/s², length of the vector",
        "rate_hz": rate_hz * (1 if signed else _FINER),
        "first_s": first / rate_hz - before_s,
        "count": values.shape[1],
        "largest": largest,
        "limit": limit,
        "exceeded": bool(np.abs(values).max(initial=0.0) > limit),
        "values": _packed(
            np.rint(32767 * share).astype("<i2")
            if signed
            else np.rint(255 * np.sqrt(share)).astype(np.uint8)
        ),
    }


def _motion(exported: ExportedDesign, times: _Times, *, signed: bool) -> Tree:
    """Return what is repeated, and speeds: at the clearest one the waves can be followed."""
    design, limb = exported.design, exported.limb
    seen = replace(exported.view, slow_motion=0.0, delay_removed=True)
    name = moving_name(design.limb)
    moving = exported.value(name, moving_block=block_of(times[0]))
    begin_s, end_s, slower = animation_of(design, seen, moving)
    if not signed and name == "moving_z":
        # The length of a vector moves twice as fast.
        slower *= 2.0
    begin_s, end_s = max(begin_s, times[0]), min(end_s, times[1])
    if not begin_s < end_s:
        begin_s, end_s = times
    rate_hz, before_s = moving.sample_rate_hz, moving.delay_s
    first, end = (
        round((time_s + before_s) * rate_hz) - moving.first for time_s in (begin_s, end_s)
    )
    loudest = np.square(moving.signals[..., first : end + 1]).sum(axis=(0, 1)).argmax()
    least = least_slow_motion(limb, "z" if signed else "magnitude", _FRAMES_PER_S)
    return {
        "loop": {
            "begin_s": begin_s,
            "end_s": end_s,
            "loudest_s": (first + moving.first + int(loudest)) / rate_hz - before_s,
        },
        "clearest": ceil(slower),
        "speeds": sorted({ceil(slower), *(factor for factor in _SPEEDS if factor >= least)}),
    }


# ---- curves ----


def _curve(
    samples: Floats, start_s: float, rate_hz: float, times: tuple[float, float], *, hides: bool
) -> Tree | None:
    """Return lowest and highest samples of pieces within ``times``, in 8 bits; None: none is there.

    A curve that ``hides`` its samples has the peak of each piece, above and below.
    """
    first = max(ceil((times[0] - start_s) * rate_hz), 0)
    part = samples[first : max(floor((times[1] - start_s) * rate_hz) + 1, first)]
    if not part.size:
        return None
    per_piece = ceil(part.size / _MOST_POINTS)
    if hides:
        per_piece = max(per_piece, ceil(_LEAST_PIECE_S * rate_hz))
    pieces = np.arange(0, part.size, per_piece)
    low, high = np.minimum.reduceat(part, pieces), np.maximum.reduceat(part, pieces)
    peak = max(float(high.max()), -float(low.min()))
    if hides:
        high = np.maximum(high, -low)
        low = -high
    scale = 127 / (peak or 1.0)
    packed = [_packed(np.rint(values * scale).astype(np.int8)) for values in (low, high)]
    return {
        "first_s": start_s + first / rate_hz,
        "step_s": per_piece / rate_hz,
        "peak": peak,
        "low": packed[0],
        "high": packed[1],
    }


def _traces(exported: ExportedDesign, outputs: Sequence[int], times: _Times) -> list[Tree]:
    if not outputs:
        return []
    values = exported.values(
        {"selected_traces", "response_time_s"}, outputs=tuple(outputs), delay_removed=True
    )
    begin_s, rate_hz = float(values["response_time_s"][0]), exported.sample_rate_hz
    traces = []
    for number, trace in zip(outputs, values["selected_traces"], strict=True):
        hides = not exported.limb.synthetic
        curve = _curve(trace, begin_s, rate_hz, times, hides=hides)
        name = output_name(number, exported.design.limb).name
        peak = f", peak {curve['peak']:.3g} m/s²" if curve else ""
        traces.append({"text": f"Output {number}, {name}{peak}", "curve": curve})
    return traces


def _about(limb: Limb, inputs: Sequence[int]) -> str:
    whose = limb_label(limb.name)
    # The mark of a synthetic limb says that it is made up.
    sentence = "" if limb.synthetic else f" {whose.sentence}"
    driven = "the places with large rings are driven" if inputs else "nothing is driven"
    drawn = " The hand shown is a drawing, not that person's." if _is_published(limb) else ""
    return (
        f"A prediction: how the skin of hand and arm vibrates while {driven}. "
        f"Limb: {whose.title}.{sentence}{drawn}"
    )


def _passed_on(limb: Limb) -> str:
    if limb.synthetic:
        return "acceleration of all outputs in 16 bits"
    drawn = "; drawn on a hand of this project" if _is_published(limb) else ""
    return f"length of the acceleration of all outputs in 8 bits, no responses{drawn}"


def _about_traces(limb: Limb, view: View) -> str:
    left_out = len(view.outputs) - _MOST_TRACES
    parts = [
        f"Acceleration, {signal_label(view.axes, view.method)}",
        *([] if limb.synthetic else [f"peaks in pieces of {1e3 * _LEAST_PIECE_S:g} ms or more"]),
        *([f"{counted(left_out, 'more output')} selected"] if left_out > 0 else []),
    ]
    return f"{'; '.join(parts)}."


def _track(exported: ExportedDesign, track: Input, played: _Played, times: _Times) -> Tree:
    design = exported.design
    start, samples = played
    rate_hz, name = exported.sample_rate_hz, input_name(track.location, design.limb).name
    audible = track in audible_inputs(design.inputs)
    called = f"Place {track.location}, {name}, {amplitude_text(design, track)}"
    called = called if audible else f"{called}, not heard"
    return {
        "name": called,
        "text": f"{called}: {clips_text(track)}",
        "audible": audible,
        "curve": _curve(samples, start / rate_hz, rate_hz, times, hides=False),
        "clips": [
            {"span_s": (clip.onset_s, clip.end_s), "text": clip_description(clip)}
            for clip in track.clips
        ],
    }


def _sound(exported: ExportedDesign, played: Sequence[_Played], times: _Times) -> Tree | None:
    """Return the sum of all drives, as loud as 16 bits hold, and the same two octaves higher.

    There the phase of each drive runs four times as fast under the same envelope.
    """
    rate_hz, tracks = exported.sample_rate_hz, exported.design.inputs
    first, end = (round(time_s * rate_hz) for time_s in times)
    heard = audible_inputs(tracks)
    drives = np.zeros((len(heard), end - first))
    rows = iter(drives)
    for track, (start, samples) in zip(tracks, played, strict=True):
        if track in heard:
            part = samples[max(first - start, 0) : max(end - start, 0)]
            at = max(start - first, 0)
            next(rows)[at : at + part.size] = track.amplitude * part
    if not drives.any():
        return None
    finer = ceil(_SOUND_HZ / rate_hz)
    drives = by_ratio(drives, Fraction(finer), rate_hz)
    n_times = drives.shape[1]
    turning = scipy.signal.hilbert(drives, scipy.fft.next_fast_len(n_times))[:, :n_times]
    higher = np.abs(turning) * np.cos(2**_OCTAVES_UP * np.angle(turning))
    plain, up = (
        np.rint(mixed * (32767 / (np.abs(mixed).max() or 1.0))).astype("<i2")
        for mixed in (drives.sum(axis=0), higher.sum(axis=0))
    )
    return {
        "rate_hz": finer * rate_hz,
        "first_s": times[0],
        "plain": _packed(plain),
        "up": _packed(up),
    }


# ---- snapshots ----


def _snapshots(exported: ExportedDesign, maps: dict[str, Tree]) -> list[Tree]:
    """Return the snapshots beside the design, as in the window; their maps are added to ``maps``.

    There are none without stored ones.
    """
    design, stored = exported.design, exported.view.snapshots
    if not stored:
        return []
    beside = sorted(with_edited(stored, design), key=lambda snapshot: snapshot.number)
    return [
        {"title": name, **_map_of_levels(snapshot.design, exported.view, maps)}
        for snapshot, name in zip(beside, _names(beside, design), strict=True)
    ]


def _names(beside: Sequence[Snapshot], shown: Design) -> list[str]:
    """Return names of snapshots, with the part of the title that tells them, or the frequency."""
    titles = [each.title or each.design.title for each in beside]
    told = [
        title if each.title or titles.count(title) == 1 else ""
        for each, title in zip(beside, titles, strict=True)
    ]
    of_designs = [title for each, title in zip(beside, told, strict=True) if not each.title]
    own = own_parts(list(filter(None, of_designs)))
    known_hz = [frequency_of(each.design) for each in beside]
    single = ["" if hz is None or hz == inf else f"{hz:g}\N{NO-BREAK SPACE}Hz" for hz in known_hz]
    this, names = shown_snapshot(beside, shown), []
    for each, title, hz in zip(beside, told, single, strict=True):
        called = snapshot_name(each.number).removeprefix("the ").capitalize()
        called = f"{called}, shown above" if each is this else called
        tells = own.get(title, title) or (hz if single.count(hz) == 1 else "")
        names.append(" · ".join(filter(None, (called, tells))))
    return names


def _map_of_levels(design: Design, view: View, maps: dict[str, Tree]) -> Tree:
    view = replace(view_on(design.limb, view), axes=axes_on(design.limb, view.axes))
    try:
        levels = levels_of(design, None, view)
    except SkinSourceError as error:
        # The limb may be missing here, or an input cannot be played.
        return {"about": str(error)}
    if design.limb not in maps:
        maps[design.limb] = _map_of(levels.limb, levels.surface)
    return {
        "about": limb_label(design.limb).title,
        "levels": _hundredths(levels.values),
        "noisy": levels.noisy,
        "inputs": levels.places,
        "map": list(maps).index(design.limb),
    }
