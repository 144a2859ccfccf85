"""Studies: sweeps, scenes and figures of the paper, checks of recordings, accuracy."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
