"""Single wavelets, and trains of them that spread or draw together."""

from skinsource.presets.preset import Preset
from skinsource.presets.shipped.making import preset
from skinsource.waveforms import Chirplet, Gabor, Morlet, Ricker, WaveletTrain

_UP = (50.0, 84.1, 141.4, 237.8, 400.0)
_TRAIN = (
    "Dandu, Shao, Stanley and Visell, Spatiotemporal haptic effects from a single actuator via "
    "spectral control of cutaneous wave propagation, IEEE World Haptics Conference, 2019. These "
    "frequencies and slots are our choice."
)
_RICKER = "Ricker, The form and laws of propagation of seismic wavelets, Geophysics 18, 1953."
_GABOR = "Gabor, Theory of communication, Journal of the IEE 93, 1946. The frequency is our choice."
_MORLET = (
    "Grossmann and Morlet, Decomposition of Hardy functions into square integrable wavelets of "
    "constant shape, SIAM J. Math. Analysis 15, 1984. The frequency is our choice."
)
_CHIRPLET = (
    "Mann and Haykin, The chirplet transform: physical considerations, IEEE Trans. Signal "
    "Processing 43, 1995. The numbers are our choice."
)

WAVELETS: tuple[Preset, ...] = (
    preset(
        "Ricker pulse",
        "wavelet, pulse, short",
        "The shortest pulse about 100 Hz that leaves no movement behind.",
        Ricker(100.0),
        source=f"{_RICKER} The frequency is our choice.",
    ),
    preset(
        "Gabor 80 Hz",
        "wavelet, burst, low",
        "A burst that is narrow in time and frequency; low, so that it travels far.",
        Gabor(80.0),
        source=_GABOR,
    ),
    preset(
        "Gabor 250 Hz",
        "wavelet, burst, high",
        "A burst that is narrow in time and frequency; high, so that it stays near.",
        Gabor(250.0),
        source=_GABOR,
    ),
    preset(
        "Morlet 150 Hz",
        "wavelet, burst",
        "A burst of six cycles whose mean is 0.",
        Morlet(150.0),
        source=_MORLET,
    ),
    preset(
        "Rising chirplet",
        "wavelet, chirp, rising",
        "A burst whose frequency rises through 150 Hz.",
        Chirplet(150.0, 1500.0, 0.03),
        source=_CHIRPLET,
    ),
    preset(
        "Contracting train",
        "wavelet, train, contracting, single actuator",
        "Five wavelets from 50 up to 400 Hz: what is felt draws together about the actuator.",
        WaveletTrain(_UP),
        source=_TRAIN,
    ),
    preset(
        "Expanding train",
        "wavelet, train, expanding, single actuator",
        "Five wavelets from 400 down to 50 Hz: what is felt spreads away from the actuator.",
        WaveletTrain(_UP[::-1]),
        source=_TRAIN,
    ),
    preset(
        "Contracting train, equal energy",
        "wavelet, train, contracting, single actuator",
        "Five wavelets from 50 up to 400 Hz with the same energy each. Edit > Equal on the skin "
        "makes them equal where they are felt.",
        WaveletTrain(_UP, equalise="energy"),
        source=_TRAIN,
    ),
    preset(
        "Breathing train",
        "wavelet, train, expanding, contracting, single actuator",
        "Nine wavelets, from 400 down to 50 Hz and back: what is felt spreads and draws together.",
        WaveletTrain((*_UP[::-1], *_UP[1:])),
        source=_TRAIN,
    ),
)
