"""What is said of an export beside its numbers: on the sheet, in a terminal, in the sidecars."""

from collections.abc import Sequence

from skinsource.resampling.kernel import half_transition
from skinsource.stimulus.wiring import FULL_SCALE_UNIT
from skinsource.stimulus_export.edges import edge_words
from skinsource.stimulus_export.preparing import Prepared
from skinsource.stimulus_formats import Outgoing

#: Energy that a channel may lose to the rate unasked, in dB: about the smallest difference in
#: strength that is felt.
MOST_LOSS_DB = 1.0
#: What is less is not said: ten times what `skinsource.resample` promises within its pass band.
LEAST_LOSS_DB = 0.01
# What samples are that were not equalised, by the unit of the drive.
_RAW = {
    "m/s²": "raw accelerations",
    "V": "volts of the design",
    FULL_SCALE_UNIT: "volts of the design",
}


def edges_of(ready: Prepared) -> str:
    """Which channels begin or end hard, in words; "": none."""
    return edge_words([one.stimulus for _, one in ready.files], ready.cut)


def loses_of(ready: Prepared, only: Outgoing | None = None) -> str:
    """What of the drive is not in the files, or not in one of them, in words; "": nothing."""
    files = [one for _, one in ready.files] if only is None else [only]
    return " ".join(filter(None, (ready.format.loses(files[0].choices), lost_at_rate(files))))


def lost_at_rate(files: Sequence[Outgoing]) -> str:
    """How much of which channels their rate does not hold, in words; "": nothing."""
    losing = [
        f"channel {channel.number} ({channel.title}) loses {channel.loss_db:.2g} dB of its energy"
        + (f" in {one.name}" if len(files) > 1 else "")
        for one in files
        for channel in one.stimulus.channels
        if channel.loss_db >= LEAST_LOSS_DB
    ]
    if not losing:
        return ""
    stimulus = files[0].stimulus
    lower_hz = min(stimulus.sample_rate_hz, stimulus.own_rate_hz)
    passed_hz = (1.0 - half_transition(lower_hz)) * 0.5 * lower_hz
    return (
        f"At {stimulus.sample_rate_hz:.10g} Hz what lies above {passed_hz:.0f} Hz is weakened or "
        f"lost: {', '.join(losing)}."
    )


def refused_loss_of(ready: Prepared) -> str:
    """What to do where a channel loses more to the rate than it may unasked; "": none does."""
    if max(one.loss_db for one in ready.drives.channels) <= MOST_LOSS_DB:
        return ""
    own_hz = ready.drives.own_rate_hz
    rate = "" if ready.format.fixed_rate else f"choose {own_hz:g} Hz, the rate of the design, or "
    return f"More than {MOST_LOSS_DB:g} dB is lost: {rate}lower the frequencies."


def equalised_of(ready: Prepared) -> str:
    """What the samples are equalised for, and by which equaliser, in words."""
    if ready.equaliser is None:
        return f"Not equalised ({_RAW.get(ready.drives.unit, 'raw drives')})"
    through = ready.actuation if ready.rig is None else ready.rig
    title = through.title if through is not None and through.title else "the rig"
    return f"Equalised for {title} ({ready.equaliser.title.lower()})"


def calibration_of(ready: Prepared) -> str:
    """Whether m/s² follow from the samples, in words."""
    return ready.files[0][1].calibration
