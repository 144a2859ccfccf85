from . import devices as devices
from . import mix as mix
from . import mixer as mixer
from . import session as session
from . import stream as stream
