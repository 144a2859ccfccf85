from . import matching as matching
from . import rig_measuring as rig_measuring
