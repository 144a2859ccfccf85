"""The scenes of the paper: panels of its figures as designs that can be opened and edited.

Each is a design file in the data folder, with the view that shows it; ``scenes.toml`` there tells
what each shows.

>>> import skinsource as ss
>>> ss.scenes.names()[:3]
('1C', '1D', '1E')
>>> opened = ss.scenes.open_scene("2F", available=("synthetic-3",))
>>> [condition.label for condition in opened.conditions]
['Input 8', 'Input 13', 'Both']
>>> opened.synthetic
True
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
