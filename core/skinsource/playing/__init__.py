"""To play a stimulus on actuators while it is being made.

A `Deck` holds what is played and what is wanted next; `next_block` computes one block of samples
from it, and is all that happens between a `Mix` and the device, so that it is tested without one.
A `Stream` lets a device call it.  Nothing of sounddevice is imported before somebody asks.
"""

from skinsource.playing.block import next_block
from skinsource.playing.deck import Deck
from skinsource.playing.devices import Device, device_of, rates_of
from skinsource.playing.ending import Ending
from skinsource.playing.gain import HIGHEST_DB, LOWEST_DB, START_DB
from skinsource.playing.meters import Levels
from skinsource.playing.mix import Mix, mix_of
from skinsource.playing.output import Output, output_from_text
from skinsource.playing.output_of_place import outputs_by_place
from skinsource.playing.session import Playing, Session
from skinsource.playing.stream import Stream
from skinsource.playing.timing import Delay

__all__ = [
    "HIGHEST_DB",
    "LOWEST_DB",
    "START_DB",
    "Deck",
    "Delay",
    "Device",
    "Ending",
    "Levels",
    "Mix",
    "Output",
    "Playing",
    "Session",
    "Stream",
    "device_of",
    "mix_of",
    "next_block",
    "output_from_text",
    "outputs_by_place",
    "rates_of",
]
