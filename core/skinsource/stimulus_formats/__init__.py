"""What a stimulus can be exported as: one module per format, listed in `FORMATS`."""

from skinsource.stimulus_formats.formats import FORMATS, export_formats, format_named
from skinsource.stimulus_formats.stimulus_format import Outgoing, StimulusFormat

__all__ = ["FORMATS", "Outgoing", "StimulusFormat", "export_formats", "format_named"]
