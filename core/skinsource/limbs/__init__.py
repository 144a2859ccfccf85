"""Limbs: what one is, where its places are, and the measured, synthetic and own ones."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
