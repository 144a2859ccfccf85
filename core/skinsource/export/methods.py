"""The methods text: what a paper says of a stimulus, made from its design."""

from __future__ import annotations

import numpy as np

from skinsource.actuators.actuation import Actuation
from skinsource.actuators.equalising import Equaliser
from skinsource.actuators.rigs import Rig
from skinsource.base.arguments import checking
from skinsource.base.errors import counted, lowered, sentence
from skinsource.design.amplitudes import amplitude_meaning, amplitude_text
from skinsource.design.clips import Clip
from skinsource.design.design import Design, Input, View, audible_inputs, view_on
from skinsource.design.labels import level_label, limb_label, signal_label
from skinsource.engine.evaluation import evaluate
from skinsource.export.formats import format_named
from skinsource.export.stimulus_export.options import StimulusOptions
from skinsource.export.stimulus_export.preparing import PreparedStimulus, prepare_stimulus
from skinsource.limbs.locations import input_name
from skinsource.limbs.own_limbs import facts_of
from skinsource.specs.models import specs_of
from skinsource.specs.numbers import NumberSpec
from skinsource.version import __version__

# Inputs, and clips of one input, that are described; the others are counted.
_MOST_INPUTS, _MOST_CLIPS = 2, 2


@checking
def methods_text(
    design: Design,
    view: View | None = None,
    *,
    format: str = "wav",
    rate_hz: int | None = None,
    options: StimulusOptions | None = None,
    actuation: Actuation | None = None,
    rig: Rig | None = None,
    equaliser: Equaliser | None = None,
) -> str:
    """Return a paragraph on a design for the methods section of a paper, of about 80 words.

    Parameters
    ----------
    design, view
        The design; axes, method and span of its levels.
    format, rate_hz, options, actuation, rig, equaliser
        How it is exported, as of `skinsource.export_stimulus`.

    Examples
    --------
    >>> import skinsource as ss
    >>> tone = ss.track(7, ss.waveforms.Tone(frequency_hz=100.0))
    >>> text = ss.methods_text(ss.Design(limb="synthetic-1", inputs=(tone,)))
    >>> print(text.partition(": ")[2].partition(". ")[0])
    Tone 100 Hz, 200 ms, 1 m/s², at Digit II, pad (place 7)
    """
    ready = prepare_stimulus(
        design,
        format_named(format),
        rate_hz,
        options or StimulusOptions(),
        actuation=actuation,
        rig=rig,
        equaliser=equaliser,
    )
    return methods_of(design, view or View(), ready)


def methods_of(design: Design, view: View, ready: PreparedStimulus) -> str:
    """Return the text for a stimulus that is prepared already."""
    view, facts = view_on(design.limb, view), facts_of(design.limb)
    levels_db = evaluate(design, "output_levels_db", view=view)["output_levels_db"]
    loudest = int(np.nanargmax(levels_db)) + 1
    level_db = float(levels_db[loudest - 1])
    tracks = audible_inputs(design.inputs)
    described = [_input_words(track, design) for track in tracks[:_MOST_INPUTS]]
    if len(tracks) > _MOST_INPUTS:
        described.append(f"and {counted(len(tracks) - _MOST_INPUTS, 'more input')}")
    through = "" if design.actuated is None else f", through {design.actuated.words}"
    origin = "from modelled responses" if facts.synthetic else "from measured responses"
    level = f"{level_db:.1f}".replace("-", "\N{MINUS SIGN}")
    return " ".join(
        (
            f"Stimuli were designed with SkinSource studio {__version__}: {'; '.join(described)}.",
            f"Amplitudes: {lowered(amplitude_meaning(design))}.",
            f"The acceleration at {facts.n_outputs} outputs of the limb "
            f"{limb_label(design.limb).title} was predicted{through}, {origin}.",
            f"Its {level_label(view.span)} ({signal_label(view.axes, view.method)}) reached "
            f"{level} dB re 1 m/s² at output {loudest}.",
            f"Drives were written as {ready.format.title} ({ready.rate_text}, {ready.scale_text}). "
            f"{sentence(ready.equalised)}",
        )
    )


def _input_words(track: Input, design: Design) -> str:
    clips = [clip for clip in track.clips if not clip.muted]
    words = [_clip_words(clip) for clip in clips[:_MOST_CLIPS]]
    if len(clips) > _MOST_CLIPS:
        words.append(counted(len(clips) - _MOST_CLIPS, "more clip"))
    where = input_name(track.location, design.limb).name
    strength = amplitude_text(design, track)
    return f"{', '.join(words) or 'silence'}, {strength}, at {where} (place {track.location})"


def _clip_words(clip: Clip) -> str:
    waveform = clip.waveform
    frequencies = [
        f"{getattr(waveform, name):.4g}"
        for name, spec in specs_of(waveform).items()
        if isinstance(spec, NumberSpec) and spec.unit == "Hz"
    ]
    hz = f" {' to '.join(frequencies)} Hz" if frequencies else ""
    onset = f" from {round(1e3 * clip.onset_s, 1):g} ms" if clip.onset_s else ""
    gain = f" with a gain of {clip.gain:g}" if clip.gain != 1.0 else ""
    return f"{waveform.title}{hz}, {round(1e3 * clip.duration_s, 1):g} ms{onset}{gain}"
