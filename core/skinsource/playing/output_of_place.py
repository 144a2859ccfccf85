"""Which output drives which place."""

from typing import TYPE_CHECKING

from skinsource.design import Design
from skinsource.playing.output import Output

if TYPE_CHECKING:
    from skinsource.rigs import Rig


def outputs_by_place(design: Design, output: Output, rig: "Rig | None" = None) -> dict[int, int]:
    """Output of each place of a design, heard or not; none where a rig does not wire it."""
    places = tuple(dict.fromkeys(one.location for one in design.inputs))
    if rig is None or output.stand_in:
        return output.outputs_of(places)
    channels = (rig.channel_of(place) for place in places)
    return {one.place: one.output for one in channels if one is not None}
