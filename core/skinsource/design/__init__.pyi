from . import edits as edits
from . import effects as effects
from . import motions as motions
from . import recordings as recordings
from . import waveforms as waveforms
