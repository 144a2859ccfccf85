"""Edits of a design and of the view on it: pure functions that return an `Edit`.

An edit that cannot be done is a `Refusal` with one sentence, whatever it gets.  Selections and
questions raise an `InvalidInputError` for arguments of wrong types.
To add one, write a function in the module of its subject, and name it in `__init__.pyi`.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
