"""A clip that is stretched does not sound at the frequency of its waveform: words say so."""

import pytest

import skinsource as ss
from skinsource.design.clips import Clip
from skinsource.design.effects.level import Fade
from skinsource.design.effects.time import Stretch
from skinsource_gui.fields.inputs import clip_text
from skinsource_gui.plots.pictures import stimulus_text

TONE = ss.waveforms.Tone(frequency_hz=100.0, duration_s=0.2)


@pytest.mark.parametrize(
    ("effects", "text", "through"),
    [
        ((), "Tone 100 Hz", "200 ms"),
        ((Fade(),), "Tone 100 Hz", "200 ms through fade"),
        ((Stretch(factor=2.0),), "Tone 100 Hz, stretched ×2", "400 ms through stretch ×2"),
        ((Stretch(to_s=0.1),), "Tone 100 Hz, stretched ×0.5", "100 ms through stretch ×0.5"),
        (
            (Stretch(factor=2.0, pitch="stays"),),
            "Tone 100 Hz",
            "400 ms through stretch ×2 that keeps frequencies",
        ),
        ((Stretch(factor=2.0, on=False),), "Tone 100 Hz", "200 ms"),
    ],
)
def test_words_on_a_clip_say_by_what_it_is_stretched(effects, text, through):
    clip = Clip(waveform=TONE, effects=effects)
    assert clip_text(clip) == text
    design = ss.Design(limb="synthetic-1", inputs=(ss.Input(location=7, clips=(clip,)),))
    assert stimulus_text(design).endswith(f": Tone 100 Hz, {through}")


def test_what_is_turned_in_front_of_an_audience_is_said_to_be_stretched(open_window):
    clip = Clip(waveform=TONE, effects=(Stretch(factor=2.0),))
    design = ss.Design(limb="synthetic-1", inputs=(ss.Input(location=7, clips=(clip,)),))
    panel = open_window(design).panel("frequency_and_amplitude")
    assert panel._heading.text() == "Tone, stretched ×2 at place 7"
