from . import scenes as scenes
from . import sweeps as sweeps
