"""How long the studio takes to start, as a ratio to the bare imports that its window needs.

Fresh processes in turn, the files in the system's cache, medians:

imports
    numpy, scipy.fft, PySide6.QtWidgets, QtGui, QtCore and pyqtgraph, and nothing else;
painted
    the studio, as ``skinsource-gui`` starts it, until its first window is painted with all its
    panels: hand, inputs and inspector can be used, maps and curves say that they are prepared;
complete
    the same window with all results of the start design painted.

One more studio tells its memory when it has come to rest.

    QT_QPA_PLATFORM=offscreen python benchmarks/start.py [--rounds 12]
"""

import argparse
import json
import os
import platform
import statistics
import subprocess
import sys
from pathlib import Path
from time import monotonic

from skinsource.catalogue import default_limb

MOST_TIMES_THE_IMPORTS = 1.5
MOST_IDLE_MB = 350.0
IMPORTS = (
    "-c",
    "import numpy, scipy.fft, PySide6.QtWidgets, PySide6.QtGui, PySide6.QtCore, pyqtgraph\n"
    "from time import monotonic\n"
    "print('{\"imported\":', monotonic(), '}')",
)
STUDIO = (str(Path(__file__).with_name("start_watch.py")),)


def main() -> int:
    """Print the figures; 1 if a promise is broken."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rounds", type=int, default=12)
    options = parser.parse_args()
    run(*IMPORTS), run(*STUDIO)  # fill the system's cache
    rounds = [run(*IMPORTS) | run(*STUDIO) for _ in range(options.rounds)]
    idle_mb = run(*STUDIO, "--rest")["idle_mb"]
    print(f"{platform.platform()}, Python {platform.python_version()}, {default_limb()}")
    print(f"medians (least) of {options.rounds} fresh processes each, in turn, in ms")
    for words, name in (
        ("bare imports", "imported"),
        ("first window painted", "painted"),
        ("all results painted", "complete"),
    ):
        times_ms = [1e3 * one[name] for one in rounds]
        print(f"{words:>22} {statistics.median(times_ms):6.0f} ({min(times_ms):.0f})")
    ratio = statistics.median(one["painted"] / one["imported"] for one in rounds)
    fast, small = ratio <= MOST_TIMES_THE_IMPORTS, idle_mb <= MOST_IDLE_MB
    print(
        f"first window: {ratio:.2f} x the bare imports, promised {MOST_TIMES_THE_IMPORTS}: "
        f"{'kept' if fast else 'BROKEN'}"
    )
    print(
        f"at rest with one limb: {idle_mb:.0f} MB, promised {MOST_IDLE_MB:.0f}: "
        f"{'kept' if small else 'BROKEN'}"
    )
    return int(not (fast and small))


def run(*arguments: str) -> dict[str, float]:
    """Run one fresh Python; what it noted, in seconds from its launch and in MB."""
    environment = {"QT_QPA_PLATFORM": "offscreen", "PYQTGRAPH_QT_LIB": "PySide6", **os.environ}
    begin = monotonic()
    done = subprocess.run(  # noqa: S603  one of the two above
        [sys.executable, *arguments],
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
        env=environment,
    )
    if done.returncode:
        sys.exit(f"a process that was to be measured failed:\n{done.stderr}")
    noted = json.loads(done.stdout)
    return {name: value if name == "idle_mb" else value - begin for name, value in noted.items()}


if __name__ == "__main__":
    sys.exit(main())
