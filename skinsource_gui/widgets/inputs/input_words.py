"""An input in a few words."""

from skinsource.clips import Clip
from skinsource.fields import ListSpec, NumberSpec, specs_of
from skinsource.quoting import printable
from skinsource.signals import sample_count
from skinsource.waveforms import Waveform
from skinsource_gui.widgets.fields.units import LONG_S, number_text, value_text

DURATION_FIELD = "duration_s"
#: What an input without clips plays.
EMPTY = "nothing yet"
# What is shorter is rounding, s.
_LEAST_S = 1e-9


def figure_text(waveform: Waveform) -> str:
    """Title and first number or list of a waveform, ``"Tone 100 Hz"``; of a recording its name."""
    name = getattr(waveform, "name", "")
    if name:
        return printable(name)
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
