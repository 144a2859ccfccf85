"""What the tests of presets share: any preset, for Hypothesis, and short ones by name."""

from hypothesis import strategies as st

from skinsource.design.clips import Clip, Fragment, Lane
from skinsource.design.effects.level import Fade
from skinsource.design.effects.time import Reverse
from skinsource.design.presets.presets import Preset
from skinsource.design.waveforms.pulses import Noise, Tap
from skinsource.design.waveforms.samples import Drawn
from skinsource.design.waveforms.tones import Tone

TONE = Fragment(lanes=(Lane(location=3, clips=(Clip(waveform=Tone()),)),))
text = st.text(st.characters(exclude_categories=("Cs", "Cc", "Zl", "Zp")), max_size=30)
names = text.filter(str.strip)
waveforms = st.sampled_from(
    [Tone(), Tap(), Noise(3), Drawn((0.0, 0.3, -0.7)), Tone(61.25, duration_s=0.03)]
)
clips = st.builds(
    Clip,
    onset_s=st.floats(0.0, 2.0),
    gain=st.floats(-2.0, 2.0),
    waveform=waveforms,
    effects=st.sampled_from([(), (Fade(),), (Reverse(), Fade(0.01, 0.0))]),
    muted=st.booleans(),
    label=text,
)
lanes = st.builds(
    Lane,
    location=st.integers(1, 20),
    amplitude=st.floats(-5.0, 5.0),
    offset=st.integers(0, 3),
    clips=st.lists(clips, min_size=1, max_size=3).map(tuple),
)
recipes = st.builds(
    Preset,
    name=names,
    tags=st.lists(text, max_size=3, unique=True).map(tuple),
    source=text,
    description=text,
    fragment=st.builds(Fragment, lanes=st.lists(lanes, min_size=1, max_size=3).map(tuple)),
)


def named(name, *tags, **more) -> Preset:
    return Preset(name=name, tags=tags, fragment=TONE, **more)
