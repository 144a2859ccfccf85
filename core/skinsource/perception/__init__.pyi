from .sensation import LIMITS as LIMITS
from .sensation import LIMITS_IN_SHORT as LIMITS_IN_SHORT
from .sensation import sensation_levels_db as sensation_levels_db
from .sensation import sensation_magnitude as sensation_magnitude
from .sensation import site_offsets_db as site_offsets_db
from .thresholds import CHANNELS as CHANNELS
from .thresholds import Channel as Channel
from .thresholds import threshold_rms as threshold_rms
