"""What must be confirmed before it is written."""

from collections.abc import Callable, Sequence

from skinsource.stimulus import Stimulus, scaled
from skinsource.stimulus_export.preparing import Prepared, clipped_samples
from skinsource.stimulus_export.rigged import passed_limits

#: Looks at the drives, in their own unit, and says in a sentence each which limits they pass.
#: Limits belong to a rig, not to a design.
Limit = Callable[[Stimulus], Sequence[str]]


def objections(ready: Prepared, limits: Sequence[Limit] = ()) -> tuple[str, ...]:
    """Sentences on what clips and on which limits are passed; none: it can be written."""
    found = []
    if ready.clipped:
        for path, one in ready.files:
            counts = clipped_samples(one.stimulus)
            words = [
                f"channel {channel.number} ({channel.title}) {count}"
                for channel, count in zip(one.stimulus.channels, counts.tolist(), strict=True)
                if count
            ]
            if words:
                found.append(
                    f"{path.name}: samples lie beyond full scale, where a device cuts them off: "
                    f"{', '.join(words)}."
                )
    if ready.rig is not None:
        sent = scaled(ready.drives, ready.gain)
        found.extend(passed_limits(sent, ready.rig))
    for limit in limits:
        found.extend(limit(ready.drives))
    return tuple(found)
