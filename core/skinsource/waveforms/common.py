"""Field specifications that several waveforms share."""

from skinsource.fields import ChoiceSpec, NumberSpec

DURATION = NumberSpec(
    label="Duration", unit="s", minimum=0.001, maximum=600.0, step=0.01, hint="Length of the burst"
)
WINDOW = ChoiceSpec(
    label="Window",
    options=(("none", "None"), ("tukey", "Tukey, 25 % taper"), ("hanning", "Hanning")),
    hint="Fades the burst in and out; without one it starts and ends with a click",
)
