"""Export of a stimulus to files: prepared, shown in an overview, written whole or not at all."""

from skinsource.export.stimulus_export.export import Exported, export_stimulus
from skinsource.export.stimulus_export.options import StimulusOptions, written_files
from skinsource.export.stimulus_export.preparing import (
    ChannelOverview,
    Limit,
    Overview,
    PreparedStimulus,
    overview_of,
    prepare_stimulus,
)

__all__ = [
    "ChannelOverview",
    "Exported",
    "Limit",
    "Overview",
    "PreparedStimulus",
    "StimulusOptions",
    "export_stimulus",
    "overview_of",
    "prepare_stimulus",
    "written_files",
]
