"""What rules remember beyond their latest result: drives, spectra of responses, gains."""

from skinsource.rendering.drives import Drives
from skinsource.rendering.exact_spectra import ExactSpectra
from skinsource.rendering.gains import Gains
from skinsource.rendering.of_clips.clip_waveforms import ClipWaveforms
from skinsource.rendering.of_clips.placed_chains import PlacedChains
from skinsource.rendering.response_spectra import ResponseSpectra


class Remembered:
    """Saves time and changes no result; it belongs to one thread, and graphs may share it."""

    def __init__(self) -> None:
        self.responses = ResponseSpectra()
        self.chains = PlacedChains()
        self.drives = Drives()
        self.clip_waveforms = ClipWaveforms(self.drives.clips)
        self.gains = Gains(self.drives)
        self.exact_spectra = ExactSpectra()
