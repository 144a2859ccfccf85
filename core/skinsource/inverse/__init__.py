"""Inverse design: from what is wanted on the skin to the drives that make it.

>>> import skinsource as ss
>>> focus = ss.inverse.focus("synthetic-1", target=9, frequencies_hz=[100.0])
>>> focus.drives.shape
(1, 20)
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
