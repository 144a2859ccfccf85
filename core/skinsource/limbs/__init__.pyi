from . import locations as locations
