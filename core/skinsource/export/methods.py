"""The methods text: what a paper says of a stimulus, made from its design."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np

from skinsource.actuators.actuation import Actuation
from skinsource.actuators.equalising import Equaliser
from skinsource.actuators.rigs import Rig
from skinsource.base.arguments import checking
from skinsource.base.decibels import FLOOR_DB
from skinsource.base.errors import counted, lowered, sentence
from skinsource.design.amplitudes import amplitude_meaning
from skinsource.design.describing import clips_text, strength_text
from skinsource.design.design import Design, View, audible_inputs, view_on
from skinsource.design.labels import level_label, limb_label, signal_label
from skinsource.engine.evaluation import evaluate
from skinsource.export.formats import format_named
from skinsource.export.stimulus_export.options import StimulusOptions
from skinsource.export.stimulus_export.preparing import PreparedStimulus, prepare_stimulus
from skinsource.limbs.locations import input_name
from skinsource.limbs.own_limbs import axes_on, facts_of
from skinsource.version import __version__

# Inputs that are described; the others are counted.
_MOST_INPUTS = 2


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
    return methods_of(view or View(), ready)


def methods_of(view: View, ready: PreparedStimulus) -> str:
    """Return the text for a stimulus that is prepared already."""
    design = ready.design
    view, facts = view_on(design.limb, view), facts_of(design.limb)
    view = replace(view, axes=axes_on(design.limb, view.axes))
    results = evaluate(design, "output_levels_db", "limb_data", view=view)
    levels_db, note = results["output_levels_db"], results["limb_data"].note
    loudest = int(np.nanargmax(levels_db)) + 1
    level_db = float(levels_db[loudest - 1])
    reached = f"reached {level_db:.1f} dB re 1 m/s² at output {loudest}"
    if level_db <= FLOOR_DB:
        reached = "was that of silence at all outputs"
    tracks = audible_inputs(design.inputs)
    described = [
        f"{clips_text(track)}, {strength_text(design, track)}, "
        f"at {input_name(track.location, design.limb).name} (place {track.location})"
        for track in tracks[:_MOST_INPUTS]
    ]
    if len(tracks) > _MOST_INPUTS:
        described.append(f"and {counted(len(tracks) - _MOST_INPUTS, 'more input')}")
    through = "" if design.actuated is None else f", through {design.actuated.words}"
    part = ""
    if ready.cut:
        sent = ready.files[0].sent
        start_s, end_s = sent.start_s + ready.lead_in_s, sent.start_s + sent.duration_s
        part = f" from {1e3 * start_s:.4g} to {1e3 * (end_s - ready.tail_s):.4g} ms"
    origin = "from modelled responses" if facts.synthetic else "from measured responses"
    about = f" ({note})" if note else ""
    text = " ".join(
        (
            f"Stimuli were designed with SkinSource studio {__version__}: {'; '.join(described)}.",
            f"Amplitudes: {lowered(amplitude_meaning(design))}.",
            f"The acceleration at {facts.n_outputs} outputs of the limb "
            f"{limb_label(design.limb).title} was predicted{through}, {origin}{about}.",
            f"Its {level_label(view.span)} ({signal_label(view.axes, view.method)}) {reached}.",
            f"Drives{part} are written as {ready.format.title} ({ready.rate_text}, "
            f"{ready.scale_text}). "
            f"{sentence(ready.equalised)}",
        )
    )
    return re.sub(r" -(?=\d)", " \N{MINUS SIGN}", text)
