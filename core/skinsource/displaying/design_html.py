"""A design as HTML: its words, a drawing of its tracks, and a table of its clips."""

from collections.abc import Collection, Sequence
from html import escape
from typing import Protocol

from skinsource.choice_words import SCALINGS, limb_word, word_of
from skinsource.clips import Clip
from skinsource.counting import counted
from skinsource.displaying.track_svg import Track, tracks_svg
from skinsource.locations import input_words
from skinsource.own_limbs import facts_of
from skinsource.scaling.response_scaling import Scaling

_MOST_TRACKS, _MOST_CLIPS = 20, 40


class Shown(Protocol):
    """What is shown of a design, which shows itself by this."""

    @property
    def title(self) -> str:
        """What it is called."""

    @property
    def limb(self) -> str:
        """On whom it is felt."""

    @property
    def scaling(self) -> Scaling:
        """What its amplitudes are."""

    @property
    def inputs(self) -> Sequence[Track]:
        """Its tracks."""

    @property
    def clips(self) -> Sequence[Clip]:
        """What all of them play."""


def html_of(design: Shown, heard: Collection[int], amplitudes: Sequence[str]) -> str:
    """Return a piece of HTML that needs nothing else.

    Parameters
    ----------
    design
        What is shown.
    heard
        Which of its inputs are heard, counted from 0.
    amplitudes
        How strong each of its inputs is, in words.
    """
    title = escape(design.title) or "Design"
    limb = escape(_limb(design.limb))
    scaling = escape(word_of(SCALINGS, design.scaling).title)
    parts = [f"<p><b>{title}</b><br>{limb} · scaling: {scaling}</p>"]
    inputs = design.inputs[:_MOST_TRACKS]
    if not inputs:
        return "".join([*parts, "<p>No inputs.</p>"])
    end_s = max((clip.onset_s + clip.waveform.duration_s for clip in design.clips), default=0.0)
    rate_hz = facts_of(design.limb).sample_rate_hz
    labels = [_place(one.location, design.limb) for one in inputs]
    shown = [index in heard for index in range(len(inputs))]
    parts.append(tracks_svg(inputs, shown, labels, max(end_s, 0.02), rate_hz))
    parts.append(_table(design, amplitudes))
    return "".join(parts)


def _table(design: Shown, amplitudes: Sequence[str]) -> str:
    rows = [
        (one.location, amplitude, clip)
        for one, amplitude in zip(design.inputs[:_MOST_TRACKS], amplitudes, strict=False)
        for clip in one.clips
    ]
    cells = [
        f"<tr><td>{location}</td><td>{amplitude}</td><td>{1e3 * clip.onset_s:g} ms</td>"
        f"<td>{escape(clip.waveform.title)}</td><td>{escape(str(clip.waveform))}</td></tr>"
        for location, amplitude, clip in rows[:_MOST_CLIPS]
    ]
    left_out = len(design.clips) - len(cells)
    more = f"<p>… and {counted(left_out, 'more clip')}</p>" if left_out > 0 else ""
    heads = ("Place", "Amplitude", "Onset", "Waveform", "")
    head = "".join(f"<th>{one}</th>" for one in heads)
    return f"<table><tr>{head}</tr>{''.join(cells)}</table>{more}"


def _limb(name: str) -> str:
    title = limb_word(name).title
    return title if title == name else f"{title} ({name})"


def _place(location: int, limb: str) -> str:
    here = 1 <= location <= facts_of(limb).n_inputs
    return f"{location} {input_words(location, limb).short_name}" if here else f"place {location}"
