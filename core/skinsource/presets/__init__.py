"""The library: clips that are kept under a name, to be placed in any design.

A preset is a `skinsource.clips.Fragment` with a name, tags, a source and a description.  Each is a
file of its own, see `skinsource.presets.preset_file`: those that the library ships lie in its data
folder, and are made by ``python -m skinsource.presets.shipped``; those of the user in the user's.
"""

from skinsource.presets.fragment_mix import mixed
from skinsource.presets.preset import Preset, tags_of
from skinsource.presets.preset_file import SUFFIX, preset_from, preset_text, read_preset
from skinsource.presets.searching import matching
from skinsource.presets.shelf import (
    Entry,
    Fault,
    Shelf,
    read_shelf,
    shipped_folder,
    users_folder,
)
from skinsource.presets.storing import delete_preset, rename_preset, save_preset
from skinsource.presets.taking import whole_design

__all__ = [
    "SUFFIX",
    "Entry",
    "Fault",
    "Preset",
    "Shelf",
    "delete_preset",
    "matching",
    "mixed",
    "preset_from",
    "preset_text",
    "read_preset",
    "read_shelf",
    "rename_preset",
    "save_preset",
    "shipped_folder",
    "tags_of",
    "users_folder",
    "whole_design",
]
