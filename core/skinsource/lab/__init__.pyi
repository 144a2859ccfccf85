from . import calibrating as calibrating
from . import matching as matching
from . import playing as playing
from . import rig_measuring as rig_measuring
