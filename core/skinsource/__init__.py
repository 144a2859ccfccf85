"""Headless library of SkinSource studio: stimuli in, skin vibration out.

>>> import skinsource as ss
>>> limb = ss.load_limb("synthetic-1")
>>> tone = ss.sinusoid(100.0, 0.1)
>>> acceleration = ss.predict(limb, [tone], [7])
>>> acceleration.shape
(72, 3, 651)

Or with a design, as the studio has it and saves it:

>>> track = ss.track(7, ss.waveforms.Tone(frequency_hz=100.0))
>>> design = ss.Design(limb="synthetic-1", inputs=(track,))
>>> ss.evaluate(design, "output_levels_db")["output_levels_db"].shape
(72,)
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
