"""From recipes to what files and the clipboard hold, and back.

Recipes describe their fields (`skinsource.fields`), so one codec carries all of them: `encode`
makes a plain tree of a recipe, `decode` a recipe of a tree.  A tree travels as the image of an
HDF5 file (`skinsource.codec.image`) or as text (`skinsource.codec.text`); both hold samples once
however often they are used, and both are checked before anything of them is believed.
"""

from skinsource.fields.recipes import decode, encode

__all__ = ["decode", "encode"]
