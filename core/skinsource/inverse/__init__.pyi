from .focusing import Focus as Focus
from .focusing import focus as focus
from .focusing import loaded as loaded
