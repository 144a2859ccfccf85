from .thresholds import CHANNELS as CHANNELS
from .thresholds import LIMITS as LIMITS
from .thresholds import LIMITS_IN_SHORT as LIMITS_IN_SHORT
from .thresholds import Channel as Channel
from .thresholds import sensation_levels_db as sensation_levels_db
from .thresholds import sensation_magnitude as sensation_magnitude
from .thresholds import site_offsets_db as site_offsets_db
from .thresholds import threshold_rms as threshold_rms
