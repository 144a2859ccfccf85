"""A monkey at the studio, with another seed each time: ``python -m tests.nightly.monkey``.

Prints the seed, and what was found.  Ends with 1 if anything was wrong; ``--seed`` repeats it.
"""

import faulthandler
import os
import resource
import sys
import tempfile
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
os.environ.setdefault("PYQTGRAPH_QT_LIB", "PySide6")

from skinsource.limbs.catalog import available_limbs
from skinsource_gui.app.app import make_application, manage_garbage_collection
from skinsource_gui.shell.window import MainWindow
from skinsource_gui.state.preferences import Preferences, start_design
from tests.gui.monkey.monkey import Monkey
from tests.gui.monkey.plain_levels import plain_levels
from tests.gui.monkey.test_monkey import recording
from tests.nightly.options import read_options

#: Of memory, at any time; levels are checked in another process, which takes up to 200 MB for it.
_MOST_MB = 1000


def main() -> None:
    # More than an hour.
    options = read_options(__doc__, 20_000)
    faulthandler.enable()
    make_application()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        os.environ["SKINSOURCE_DATA"] = name
        window = MainWindow(
            start_design("synthetic-1"),
            preferences=Preferences(folder / "studio.ini"),
            available_limbs=available_limbs(),
        )
        manage_garbage_collection(window)
        window.resize(1366, 728)
        window.show()
        window.do("arrange_design")
        window.catch_up()
        with ProcessPoolExecutor(1, get_context("spawn")) as apart:
            monkey = Monkey(window, options.seed, folder, (recording(folder),))
            monkey.levels = lambda *seen: apart.submit(plain_levels, *seen).result()
            monkey.tell = lambda count: (
                count % 1000 or print(f"{count}: {_most_mb():.0f} MB", flush=True)
            )
            tally = monkey.play(options.count)
        most_mb = _most_mb()
        print(
            f"{tally.deeds.total()} deeds; levels compared {tally.compared} times, at most "
            f"{tally.largest_difference_db:.1e} dB off; {tally.undone} steps undone and redone; "
            f"at most {most_mb:.0f} MB"
        )
        if most_mb > _MOST_MB:
            tally.faults.append(f"{most_mb:.0f} MB of memory are more than {_MOST_MB}")
        for fault in tally.faults:
            print(fault)
        if tally.faults:
            print(f"after\n{monkey.last_deeds}\nseed {options.seed}")
        window.close_unasked()
        sys.stdout.flush()
    # Python would take a thousand widgets apart in any order.
    os._exit(1 if tally.faults else 0)


def _most_mb() -> float:
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1.024e-3


if __name__ == "__main__":
    main()
