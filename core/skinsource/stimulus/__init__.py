"""What the actuators get: one channel per place, as it is exported, played and swept.

`stimulus_of` makes it from a design, from the same samples that the prediction is made of.  What
is done to it on the way out is a function from stimulus to stimulus each.
"""

from skinsource.stimulus.channel import Channel
from skinsource.stimulus.channel_order import in_order
from skinsource.stimulus.fades import faded
from skinsource.stimulus.full_scale import full_scale_factor, scaled
from skinsource.stimulus.of_design import Stage, stimulus_of
from skinsource.stimulus.stimulus import Stimulus
from skinsource.stimulus.sync import with_sync
from skinsource.stimulus.times import part_of_time, with_lead_in

__all__ = [
    "Channel",
    "Stage",
    "Stimulus",
    "faded",
    "full_scale_factor",
    "in_order",
    "part_of_time",
    "scaled",
    "stimulus_of",
    "with_lead_in",
    "with_sync",
]
