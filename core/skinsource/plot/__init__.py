"""Drawings of designs and of predicted levels, with matplotlib and without a window.

Each function draws into ``ax``, axes of matplotlib, or makes a figure of its own, and returns the
figure: it shows itself in a notebook, and `savefig` writes PNG, SVG and PDF with real text.  They
need the extra ``plot``.

>>> import skinsource as ss
>>> tone = ss.track(7, ss.waveforms.Tone(frequency_hz=100.0))
>>> figure = ss.plot.map(ss.Design(limb="synthetic-1", inputs=(tone,)))
>>> len(figure.axes)
2
"""

from skinsource.plot.maps import map
from skinsource.plot.signals import spectra, traces
from skinsource.plot.strips import strip

__all__ = ["map", "spectra", "strip", "traces"]
