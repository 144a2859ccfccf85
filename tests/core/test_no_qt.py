import subprocess
import sys

PROBE = """
import sys

# None in sys.modules makes every import of the name raise.
blocked = ("PySide6", "PySide2", "PyQt6", "PyQt5", "shiboken6", "pyqtgraph", "qtpy")
sys.modules.update(dict.fromkeys(blocked))
import importlib
import pkgutil

import skinsource

names = [
    module.name
    for module in pkgutil.walk_packages(skinsource.__path__, "skinsource.")
    if not module.name.endswith("__main__")
]
for name in names:
    importlib.import_module(name)
print(*sorted(names))
"""


def test_the_whole_core_imports_where_there_is_no_qt():
    result = subprocess.run(
        [sys.executable, "-W", "error", "-c", PROBE],
        check=False,
        capture_output=True,
        text=True,
        timeout=60,
    )
    assert result.returncode == 0, result.stderr
    imported = set(result.stdout.split())
    assert {
        "skinsource.engine.prediction",
        "skinsource.engine.quantities",
        "skinsource.design.waveforms.tones",
    } <= imported
