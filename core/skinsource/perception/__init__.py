"""How far above the detection threshold a vibration of the skin is.

The thresholds are of glabrous skin; most outputs lie on hairy or bony skin.  Masses and glue of
accelerometers, temperature, age and force are not in the model, people differ by 6 to 10 dB, and
what lies below 25 Hz is not measured: only differences between designs on one limb are safe.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
