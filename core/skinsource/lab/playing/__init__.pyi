from . import devices as devices
from . import mix as mix
from . import session as session
from . import stream as stream
