"""An input in a few words."""

from skinsource.base.quoting import printable
from skinsource.design.clips import Clip
from skinsource.design.effects import stretched_by
from skinsource.design.waveforms import Waveform
from skinsource.signals.generators import sample_count
from skinsource.specs.fields import ListSpec, NumberSpec, PointsSpec, RecipeSpec, TextSpec, specs_of
from skinsource_gui.widgets.fields.units import LONG_S, number_text, value_text

DURATION_FIELD = "duration_s"
#: What an input without clips plays.
EMPTY = "nothing yet"
# Names of fields of two frequencies: where it begins and where it ends.
_ENDS = (("start_hz", "end_hz"), ("low_hz", "high_hz"))
_SAID = (DURATION_FIELD, *(name for ends in _ENDS for name in ends))
# Of a path with more frequencies the lowest and the highest are told.
_MOST_TOLD, _MOST_PARTS, _MOST_LETTERS = 4, 3, 60
# What is shorter is rounding, s.
_LEAST_S = 1e-9


def figure_text(waveform: Waveform) -> str:
    """Title and frequencies of a waveform, ``"Tone 100 Hz"``; else its first number.

    Of a recording its name.
    """
    name = getattr(waveform, "name", "")
    if name:
        return printable(name)
    if path := _path_hz(waveform):
        return f"{waveform.title} {'–'.join(number_text(one, 'Hz', digits=4) for one in path)} Hz"
    for name, spec in specs_of(waveform).items():
        if isinstance(spec, ListSpec) and isinstance(spec.of, NumberSpec):
            values = getattr(waveform, name)
            ends = values[:: max(len(values) - 1, 1)]
            words = "–".join(number_text(one, spec.of.unit, digits=4) for one in ends)
            return f"{waveform.title} {words} {spec.of.unit}"
        if isinstance(spec, NumberSpec) and name != DURATION_FIELD:
            number = value_text(getattr(waveform, name), spec.unit, digits=4)
            if spec.unit:
                return f"{waveform.title} {number}"
            return f"{waveform.title}, {spec.label.lower()} {number}"
    return waveform.title


def clip_text(clip: Clip) -> str:
    """The same of a clip, and what its effects do to these frequencies: ``", stretched ×2"``."""
    return f"{figure_text(clip.waveform)}{stretched_text(clip)}"


def stretched_text(clip: Clip) -> str:
    """Behind the words on a waveform: that the clip plays it slower, or faster; else ""."""
    factor = stretched_by(clip.effects, clip.waveform.duration_s)
    return "" if factor == 1.0 else f", stretched ×{factor:.3g}"


def told_text(waveform: Waveform) -> str:
    """The same with what else it is made of, for who cannot look: ``"Square 100 Hz (duty 0.5)"``.

    Phases, and how it is windowed, are not told.
    """
    figure = figure_text(waveform)
    more: list[str] = []
    for name, spec in specs_of(waveform).items():
        value = getattr(waveform, name)
        if isinstance(spec, NumberSpec) and name not in _SAID and spec.unit != "rad":
            number = value_text(value, spec.unit, digits=4)
            if not any(
                figure.endswith(f" {one}") for one in (number, f"{spec.label.lower()} {number}")
            ):
                more.append(f"{spec.label.lower()} {number}")
        elif isinstance(spec, TextSpec) and name != "name":
            words = printable(value)
            more.append(words if len(words) <= _MOST_LETTERS else f"{words[:_MOST_LETTERS]}…")
        elif isinstance(spec, ListSpec) and isinstance(spec.of, RecipeSpec):
            inside = [told_text(one.waveform) for one in value if isinstance(one, Clip)]
            more += [*inside[:_MOST_PARTS], *["…"] * (len(inside) > _MOST_PARTS)]
    return f"{figure} ({', '.join(more)})" if more else figure


def clips_text(count: int) -> str:
    """What stands behind the words on one of ``count`` clips: ``" · 1 of 3 clips"``."""
    return f" · 1 of {count} clips" if count > 1 else ""


def duration_text(duration_s: float) -> str:
    """A length: ``"200 ms"``, ``"600 s"``."""
    if sample_count(duration_s) == 1:
        return "one sample"
    return value_text(duration_s, "s", digits=4 if duration_s >= LONG_S else 3)


def played_length_text(clip: Clip) -> str:
    """How long a clip lasts, where its effects make that another length than its waveform's."""
    if abs(clip.duration_s - clip.waveform.duration_s) < _LEAST_S:
        return ""
    return f"{duration_text(clip.duration_s)} with its effects"


def fixed_length_text(waveform: Waveform) -> str:
    """Length of a waveform that has no duration to choose, in words, or ""."""
    if DURATION_FIELD in specs_of(waveform):
        return ""
    count = sample_count(waveform.duration_s)
    samples = "" if count == 1 else f" ({count} samples)"
    fixed = "" if specs_of(waveform) else ", fixed"
    return f"{duration_text(waveform.duration_s)}{samples}{fixed}"


def _path_hz(waveform: Waveform) -> tuple[float, ...]:
    """Frequencies from which to which it goes, in this order; none where it stays at one."""
    specs = specs_of(waveform)
    for ends in _ENDS:
        if all(name in specs for name in ends):
            return tuple(getattr(waveform, name) for name in ends)
    for name, spec in specs.items():
        if isinstance(spec, PointsSpec):
            at = next((k for k, one in enumerate(spec.columns) if one.unit == "Hz"), None)
            if at is not None:
                path = [point[at] for point in getattr(waveform, name)]
                turns = tuple(one for k, one in enumerate(path) if k == 0 or one != path[k - 1])
                return turns if len(turns) <= _MOST_TOLD else (min(turns), max(turns))
    return ()
