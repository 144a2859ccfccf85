from . import devices as devices
from . import session as session
from . import stream as stream
