"""How long the studio takes to start, as a ratio to the bare imports that its window needs.

Fresh processes in turn, the files in the system's cache and their bytecode on disk, whatever the
environment says of it; medians:

imports
    numpy, scipy.fft, PySide6.QtWidgets, QtGui, QtCore and pyqtgraph, and nothing else;
painted
    the studio, as ``skinsource-gui`` starts it, until its first window is painted with all its
    panels: hand, inputs and inspector can be used, maps and curves say that they are prepared;
complete
    the same window with all results of the start design painted.

All three a few times more without bytecode, as after an update, and with no operator of a map on
disk, as at the very first start.  One more studio tells its memory when it has come to rest.

    QT_QPA_PLATFORM=offscreen python benchmarks/start.py [--rounds 12]
"""

import argparse
import json
import os
import platform
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path
from time import monotonic

from skinsource.limbs.catalog import default_limb

#: Promised, as ratios to the bare imports.
MOST_TIMES = {"painted": 1.7, "complete": 2.0, "idle_mb": 3.0}
WORDS = {
    "imported": "bare imports",
    "painted": "first window painted",
    "complete": "all results painted",
}
HERE = Path(__file__).parent
IMPORTS, STUDIO = (str(HERE / "start_imports.py"),), (str(HERE / "start_watch.py"),)


def main() -> int:
    """Print the figures; 1 if a promise is broken."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rounds", type=int, default=12)
    options = parser.parse_args()
    print(f"{platform.platform()}, Python {platform.python_version()}, {default_limb()}")
    with tempfile.TemporaryDirectory() as folder:
        # Where no bytecode may be written, each start would compile the studio, but none of what it
        # imports: that was compiled when it was installed.
        written = {"PYTHONDONTWRITEBYTECODE": "", "PYTHONPYCACHEPREFIX": f"{folder}/bytecode"}
        usual = {"SKINSOURCE_CACHE": folder, **written}
        run(IMPORTS, usual), run(STUDIO, usual)  # fill the system's cache, and the studio's own
        holds = report("usual", [usual] * (2 * options.rounds), MOST_TIMES)
        few = range(2 * max(2, options.rounds // 4))
        bare = [usual | {"PYTHONPYCACHEPREFIX": f"{folder}/{k}"} for k in few]
        report("without bytecode", bare, {})
        first = [usual | {"SKINSOURCE_CACHE": f"{folder}/{k}"} for k in few]
        report("no operator on disk", first, {})
        bare_mb, idle_mb = (
            run((*command, "--rest"), usual)["idle_mb"] for command in (IMPORTS, STUDIO)
        )
    print(f"at rest with one limb: {idle_mb:.0f} MB")
    return int(not (verdict("memory at rest", idle_mb / bare_mb, MOST_TIMES["idle_mb"]) and holds))


def report(title: str, environments: list[dict[str, str]], promises: dict[str, float]) -> bool:
    """Print medians and least of fresh processes in turn; whether the promises are kept.

    Imports and studio take the environments in turn.
    """
    rounds = [
        run(IMPORTS, environment) | run(STUDIO, other)
        for environment, other in zip(environments[::2], environments[1::2], strict=True)
    ]
    print(f"{title}: medians (least) of {len(rounds)} fresh processes each, in turn, in ms")
    holds = True
    for name, label in WORDS.items():
        times_ms = [1e3 * times[name] for times in rounds]
        ratio = statistics.median(times[name] / times["imported"] for times in rounds)
        print(
            f"{label:>22} {statistics.median(times_ms):6.0f} ({min(times_ms):.0f}) {ratio:5.2f} x"
        )
        if name in promises:
            holds &= verdict(label, ratio, promises[name])
    return holds


def verdict(label: str, ratio: float, most: float) -> bool:
    """Print a ratio to the bare imports; whether it is kept."""
    word = "kept" if ratio <= most else "BROKEN"
    print(f"{label:>22}: {ratio:.2f} x the bare imports, promised {most}: {word}")
    return ratio <= most


def run(arguments: tuple[str, ...], changes: dict[str, str]) -> dict[str, float]:
    """Run one fresh Python; what it noted, in seconds from its launch and in MB."""
    environment = {"QT_QPA_PLATFORM": "offscreen", "PYQTGRAPH_QT_LIB": "PySide6", **os.environ}
    begin = monotonic()
    done = subprocess.run(  # noqa: S603  one of the two above
        [sys.executable, *arguments],
        capture_output=True,
        text=True,
        check=False,
        timeout=120,
        env=environment | changes,
    )
    if done.returncode:
        sys.exit(f"a process that was to be measured failed:\n{done.stderr}")
    noted = json.loads(done.stdout)
    return {name: value if name == "idle_mb" else value - begin for name, value in noted.items()}


if __name__ == "__main__":
    sys.exit(main())
