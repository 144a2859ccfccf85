"""What the channels of a stimulus are called in tables and arrays."""

from collections import Counter

from skinsource.stimulus import Channel, Stimulus


def channel_names(stimulus: Stimulus) -> list[str]:
    """One name for each channel, of letters, figures and underscores: ``place_7``.

    Where several channels have one place, the input is named too; what drives no actuator has
    the number of its channel.
    """
    places = Counter(one.place for one in stimulus.channels)
    return [_name(one, alone=places[one.place] == 1) for one in stimulus.channels]


def _name(channel: Channel, *, alone: bool) -> str:
    if channel.place is None:
        return f"{channel.title.lower()}_{channel.number}"
    inputs = "_".join(str(id) for id in channel.inputs)
    return f"place_{channel.place}" if alone else f"place_{channel.place}_input_{inputs}"
