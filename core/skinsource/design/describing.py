"""Words for what is played: waveforms, clips, and whole stimuli."""

from collections.abc import Sequence

from skinsource.base.errors import counted, printable
from skinsource.design.amplitudes import amplitude_text
from skinsource.design.clips import Clip
from skinsource.design.design import Design, Input, audible_inputs
from skinsource.design.display_units import LONG_S, number_text, value_text
from skinsource.design.effects.effect import Effect
from skinsource.design.effects.level import UNCHANGED, Envelope
from skinsource.design.effects.time import Repeat, Reverse, Stretch, Trim, stretched_by
from skinsource.design.waveform import Waveform
from skinsource.design.waveforms.pulses import Noise
from skinsource.signals.generators import sample_count
from skinsource.specs.models import specs_of
from skinsource.specs.numbers import ListSpec, ModelSpec, NumberSpec, PointsSpec
from skinsource.specs.spec import ChoiceSpec, TextSpec

DURATION_FIELD = "duration_s"
# Names of pairs of fields for the first and the last frequency.
_ENDS = (("start_hz", "end_hz"), ("low_hz", "high_hz"))
# Fields that every label has already.
_LABELLED = (DURATION_FIELD, *(name for ends in _ENDS for name in ends))
# A path with more frequencies is labelled by the lowest and the highest.
_MOST_FREQUENCIES, _MOST_PARTS, _MOST_LETTERS = 4, 3, 60
# Clips of one input, and inputs, that are described; the others are counted.
_MOST_CLIPS, _MOST_INPUTS = 3, 6


def figure_text(waveform: Waveform) -> str:
    """Return title and frequencies of a waveform, ``"Tone 100 Hz"``, else its first number.

    A recording has its name.
    """
    name = getattr(waveform, "name", "")
    if name:
        return printable(name)
    if path := path_hz(waveform):
        return f"{waveform.title} {'–'.join(number_text(hz, 'Hz', digits=4) for hz in path)} Hz"
    for name, spec in specs_of(waveform).items():
        if isinstance(spec, NumberSpec) and name != DURATION_FIELD:
            number = value_text(getattr(waveform, name), spec.unit, digits=4)
            if spec.unit:
                return f"{waveform.title} {number}"
            return f"{waveform.title}, {spec.label.lower()} {number}"
    return waveform.title


def full_label(waveform: Waveform) -> str:
    """Return `figure_text` with the other fields: "Square 100 Hz (duty cycle 0.5)".

    Phases, windows and usual choices are left out.
    """
    figure = figure_text(waveform)
    more: list[str] = []
    for name, spec in specs_of(waveform).items():
        value = getattr(waveform, name)
        if isinstance(spec, NumberSpec) and name not in _LABELLED and spec.unit != "rad":
            number = value_text(value, spec.unit, digits=4)
            if not figure.endswith(f" {number}"):
                more.append(f"{spec.label.lower()} {number}")
        elif isinstance(spec, ChoiceSpec) and name != "window" and value != spec.options[0][0]:
            more.append(f"{spec.label.lower()} {dict(spec.options)[value].lower()}")
        elif isinstance(spec, ListSpec) and isinstance(spec.of, NumberSpec) and len(value) > 1:
            # The ends of frequencies stand in the figure.
            label, ends = spec.label.lower(), f"{max(value):.3g} to {min(value):.3g} {spec.of.unit}"
            more.append(f"{len(value)} {label}" if spec.of.unit == "Hz" else f"{label} {ends}")
        elif isinstance(spec, TextSpec) and name != "name":
            text = printable(value)
            more.append(text if len(text) <= _MOST_LETTERS else f"{text[:_MOST_LETTERS]}…")
        elif isinstance(spec, ListSpec) and isinstance(spec.of, ModelSpec):
            inside = [full_label(clip.waveform) for clip in value if isinstance(clip, Clip)]
            more += [*inside[:_MOST_PARTS], *["…"] * (len(inside) > _MOST_PARTS)]
    return f"{figure} ({', '.join(more)})" if more else figure


def duration_text(duration_s: float) -> str:
    """Return the text of a duration: ``"200 ms"``, ``"600 s"``."""
    if sample_count(duration_s) == 1:
        return "one sample"
    return value_text(duration_s, "s", digits=4 if duration_s >= LONG_S else 3)


def path_hz(waveform: Waveform) -> tuple[float, ...]:
    """Return the frequencies of a waveform in order; none for a constant frequency."""
    specs = specs_of(waveform)
    for ends in _ENDS:
        if all(name in specs for name in ends):
            return tuple(getattr(waveform, name) for name in ends)
    for name, spec in specs.items():
        if isinstance(spec, ListSpec) and isinstance(spec.of, NumberSpec):
            return _turns(getattr(waveform, name))
        if isinstance(spec, PointsSpec):
            at = next((k for k, column in enumerate(spec.columns) if column.unit == "Hz"), None)
            if at is not None:
                path = [point[at] for point in getattr(waveform, name)]
                return _few(_changes(path))
    return ()


def _changes(path: Sequence[float]) -> list[float]:
    return [hz for k, hz in enumerate(path) if k == 0 or hz != path[k - 1]]


def _few(path: Sequence[float]) -> tuple[float, ...]:
    return tuple(path) if len(path) <= _MOST_FREQUENCIES else (min(path), max(path))


def _turns(path: Sequence[float]) -> tuple[float, ...]:
    """Return both ends of a path, and where it turns back between them."""
    hz = _changes(path)
    inside = [b for a, b, c in zip(hz, hz[1:], hz[2:], strict=False) if (a < b) != (b < c)]
    return _few([*hz[:1], *inside, *hz[1:][-1:]])


def effects_hz(effects: Sequence[Effect], waveform: Waveform) -> tuple[float, ...]:
    """Return the frequencies of a waveform after effects, in order; none where unknown."""
    rates = [n for n, s in specs_of(waveform).items() if getattr(s, "unit", "") == "Hz"]
    hz = path_hz(waveform) or tuple(getattr(waveform, name) for name in rates[:1])
    law, lasts_s = getattr(waveform, "law", ""), waveform.duration_s
    steady = len(hz) < 2 or isinstance(waveform, Noise)
    for effect in (each for each in effects if each.on and not steady):
        before_s, lasts_s = lasts_s, effect.length(lasts_s)
        if isinstance(effect, Reverse):
            hz = hz[::-1]
        elif isinstance(effect, Repeat):
            law = ""
        elif isinstance(effect, Trim) and lasts_s < before_s:
            if not (law and lasts_s):
                return ()
            ends = effect.start_s / before_s, (effect.start_s + lasts_s) / before_s
            first, last = hz
            if law == "linear":
                hz = tuple(first + (last - first) * end for end in ends)
            else:
                hz = tuple(first * (last / first) ** end for end in ends)
    return tuple(each / stretched_by(effects, waveform.duration_s) for each in hz)


def stimulus_text(design: Design) -> str:
    """Describe what is played, where, and how strong."""
    audible = audible_inputs(design.inputs)
    parts = [
        f"Place {track.location}, {strength_text(design, track)}: {clips_text(track)}"
        for track in audible[:_MOST_INPUTS]
    ]
    if len(audible) > _MOST_INPUTS:
        parts.append(f"and {counted(len(audible) - _MOST_INPUTS, 'more input')}")
    return "; ".join(parts) or "No active input"


def strength_text(design: Design, track: Input) -> str:
    """Return the amplitude of an input, and whether it has a gain curve."""
    curve = f", with a gain curve {_points(track.gain_curve)}" if track.gain_curve else ""
    return f"{amplitude_text(design, track)}{curve}"


def clips_text(track: Input) -> str:
    """Describe the clips of an input that are not muted, each with its effects."""
    clips = [clip for clip in track.clips if not clip.muted]
    texts = [_clip_text(clip) for clip in clips[:_MOST_CLIPS]]
    if len(clips) > _MOST_CLIPS:
        texts.append(counted(len(clips) - _MOST_CLIPS, "more clip"))
    return ", ".join(texts) or "no clips"


def _clip_text(clip: Clip) -> str:
    parts = full_label(clip.waveform), duration_text(clip.duration_s)
    onset = f"at {clip.onset_s * 1e3:g} ms" if clip.onset_s else ""
    gain = f"gain {clip.gain:g}" if clip.gain != 1.0 else ""
    effects = _effect_texts(clip)
    through = f"through {', '.join(effects)}" if effects else ""
    return " ".join(part for part in (", ".join(parts), onset, gain, through) if part)


def _effect_texts(clip: Clip) -> list[str]:
    """Return the texts of the effects of a clip that are on, in their order."""
    texts, lasts_s = [], clip.waveform.duration_s
    for effect in clip.effects:
        changes = not (isinstance(effect, Envelope) and effect.points == UNCHANGED)
        if effect.on and changes:
            texts.append(_effect_text(effect, lasts_s))
        lasts_s = effect.length(lasts_s) if effect.on else lasts_s
    return texts


def _effect_text(effect: Effect, lasts_s: float) -> str:
    """Return how it changes what ``lasts_s``: ``"fade"``, ``"trim to 0–100 ms of 200 ms"``."""
    if isinstance(effect, Envelope):
        return f"an envelope {_points(effect.points)}"
    if isinstance(effect, Stretch):
        addition = " that keeps frequencies" if effect.pitch == "stays" else ""
        return f"stretch ×{effect.factor_of(lasts_s):.3g}{addition}"
    if isinstance(effect, Trim):
        start_ms, end_ms = 1e3 * effect.start_s, 1e3 * (effect.start_s + effect.length(lasts_s))
        return f"trim to {start_ms:.4g}–{end_ms:.4g} ms of {duration_text(lasts_s)}"
    return effect.title.lower()


def _points(curve: Sequence[object]) -> str:
    return f"of {counted(len(curve), 'point')}"
