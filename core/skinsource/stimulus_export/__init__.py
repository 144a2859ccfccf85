"""A stimulus leaves for files: prepared, looked at, written whole or not at all."""

from skinsource.stimulus_export.export import Exported, export_stimulus
from skinsource.stimulus_export.naming import written_files
from skinsource.stimulus_export.options import StimulusOptions
from skinsource.stimulus_export.overview import ChannelOverview, Overview, overview_of
from skinsource.stimulus_export.preparing import Prepared, prepared
from skinsource.stimulus_export.safety import Limit

__all__ = [
    "ChannelOverview",
    "Exported",
    "Limit",
    "Overview",
    "Prepared",
    "StimulusOptions",
    "export_stimulus",
    "overview_of",
    "prepared",
    "written_files",
]
