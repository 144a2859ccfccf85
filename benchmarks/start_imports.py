"""Imports what the window of the studio needs, and nothing else; see ``start.py``."""

import json
import sys
from time import monotonic

import numpy
import pyqtgraph
import PySide6.QtCore
import PySide6.QtGui
import PySide6.QtWidgets
import scipy.fft

IMPORTED = (
    numpy,
    scipy.fft,
    PySide6.QtWidgets,
    PySide6.QtGui,
    PySide6.QtCore,
    pyqtgraph,
)

noted = {"imported": monotonic()}
if "--rest" in sys.argv:
    from resident import resident_mb

    noted["idle_mb"] = resident_mb()
sys.stdout.write(json.dumps(noted))
