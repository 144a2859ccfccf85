"""Another person's hand: what those who were measured say about it, and what must be measured.

>>> import skinsource as ss
>>> tone = ss.track(7, ss.waveforms.Tone(frequency_hz=100.0))
>>> design = ss.Design(limb="synthetic-1", inputs=(tone,))
>>> found = ss.people.levels(design, limbs=["synthetic-1", "synthetic-2", "synthetic-3"])
>>> found.mean_db.shape
(72,)
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
