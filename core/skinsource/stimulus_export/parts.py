"""What of a stimulus goes to which file."""

from dataclasses import replace

from skinsource.stimulus import Stimulus, in_order, scaled, with_sync
from skinsource.stimulus_export.options import StimulusOptions
from skinsource.stimulus_formats import StimulusFormat


def parts(
    drives: Stimulus, gain: float, format: StimulusFormat, options: StimulusOptions
) -> dict[str, Stimulus]:
    """What goes to which file, by its mark; as loud as ``gain`` makes it."""
    if options.one_file_per_input:
        apart = {
            f"_input-{channel.inputs[0]}": _alone(drives, row)
            for row, channel in enumerate(drives.channels)
        }
    else:
        apart = {"": drives}
    return {
        f"{mark}{own_mark}": own
        for mark, one in apart.items()
        for own_mark, own in _own_files(_finished(scaled(one, gain), options), format)
    }


def _finished(stimulus: Stimulus, options: StimulusOptions) -> Stimulus:
    """With what is not scaled, and in the order of the outputs."""
    if options.sync:
        # What comes before is the lead-in.
        stimulus = with_sync(stimulus, at_s=options.from_s or 0.0)
    return in_order(stimulus, options.channel_map) if options.channel_map else stimulus


def _own_files(stimulus: Stimulus, format: StimulusFormat) -> list[tuple[str, Stimulus]]:
    """A file for each channel, where the format holds one: the first has no mark."""
    if not format.one_channel_each:
        return [("", stimulus)]
    return [
        (f"_channel-{row + 1}" if row else "", _alone(stimulus, row))
        for row in range(len(stimulus.channels))
    ]


def _alone(stimulus: Stimulus, row: int) -> Stimulus:
    """One channel of ``stimulus``, as the first of a file."""
    channel = replace(stimulus.channels[row], number=1)
    return stimulus.with_samples(stimulus.samples[row : row + 1], channels=(channel,))
