"""What is known of a limb before any of its responses is read."""

from dataclasses import dataclass

from skinsource.limb.axes import Axes
from skinsource.limb.band import Band
from skinsource.limb.published import (
    BAND_HZ,
    HAND_LENGTHS_MM,
    LIMB_NAMES,
    N_INPUTS,
    N_OUTPUTS,
    N_TAPS,
    PRE_TRIGGER_DELAY_S,
    SAMPLE_RATE_HZ,
)

#: Places and outputs of a limb whose results can follow each edit; of larger ones they are
#: computed as jobs: exports, sweeps and scripts.
LIVE_INPUTS, LIVE_OUTPUTS = 64, 128


@dataclass(frozen=True, slots=True, kw_only=True)
class LimbFacts:
    """Names and sizes of a limb.

    Attributes
    ----------
    name, title, sentence
        As files name it; as the window does; and what it is.
    n_inputs, n_outputs, n_taps, axes, sample_rate_hz, pre_trigger_delay_s, band_hz, hand_length_mm
        As of `Limb`.
    per_unit_drive
        As of `Limb`; the unit of that drive is not known.
    synthetic
        Whether it is computed, not measured.
    own
        Whether a lab imported it: its places are its own.
    known
        Whether there is such a limb here; if not, its sizes are those of the published ones.
    input_names, output_names
        Of an own limb, one for each; empty ones have no name.
    digest
        SHA-256 of all numbers of an own limb; empty for others, which their name stands for.
    left, mirrored
        Whether it is a left hand, and whether it is shown as a right one.
    """

    name: str
    title: str
    sentence: str
    n_inputs: int = N_INPUTS
    n_outputs: int = N_OUTPUTS
    n_taps: int = N_TAPS
    axes: Axes = "xyz"
    sample_rate_hz: float = SAMPLE_RATE_HZ
    pre_trigger_delay_s: float = PRE_TRIGGER_DELAY_S
    band_hz: Band | None = BAND_HZ
    hand_length_mm: float = 0.0
    per_unit_drive: bool = False
    synthetic: bool = False
    own: bool = False
    known: bool = True
    input_names: tuple[str, ...] = ()
    output_names: tuple[str, ...] = ()
    digest: str = ""
    left: bool = False
    mirrored: bool = False

    @property
    def missing(self) -> bool:
        """Whether a name is known and nothing else: not even in which band it was measured."""
        return bool(self.name) and not self.known

    @property
    def live(self) -> bool:
        """Whether it is small enough for results that follow each edit."""
        return self.n_inputs <= LIVE_INPUTS and self.n_outputs <= LIVE_OUTPUTS


_SENTENCES = {
    "measured": "Impulse responses measured on one person's hand and arm.",
    "synthetic": "Impulse responses computed from a model of waves in the skin, not measured.",
}


def _published(name: str) -> LimbFacts:
    kind, _, number = name.partition("-")
    length_mm = HAND_LENGTHS_MM[int(number) - 1]
    return LimbFacts(
        name=name,
        title=f"{kind.capitalize()} {number} ({length_mm:g} mm)",
        sentence=_SENTENCES[kind],
        hand_length_mm=length_mm,
        synthetic=kind == "synthetic",
    )


#: Of the published limbs and of the synthetic ones, by name.
PUBLISHED = {name: _published(name) for name in LIMB_NAMES}
