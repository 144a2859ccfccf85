"""What the window needs of the library; who starts the studio imports this before Qt.

Once Qt is imported, PySide6 reads the source of every module that an import statement names, to
see whether it uses PySide6.  What is there already costs it nothing.
"""

from skinsource import allocation, catalogue, export, quantities, synthetic
from skinsource.edits import parts
from skinsource.keeping import crash_log, left_over

#: Each brings what it needs itself.
FIRST = (allocation, catalogue, crash_log, export, left_over, parts, quantities, synthetic)
