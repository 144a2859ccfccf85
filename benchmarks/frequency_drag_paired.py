"""How long an edit takes beside what it took in another version of the studio.

Both drag the frequency as their own `benchmarks/frequency_drag.py` does, each in a process of its
own, in turn: this one and the other, the other and this one, and so on, so that what slows the
machine down for a while slows both.  Of each run the median of its edits counts, by the clock; of
each round the ratio of the two; of all rounds the median of the ratios, with the least and the
largest beside it.

    git worktree add --detach ../old REVISION
    python benchmarks/frequency_drag_paired.py ../old
"""

import argparse
import os
import statistics
import subprocess
import sys
from pathlib import Path

ROUNDS, MOST = 7, 1.3
_SCRIPT = Path("benchmarks") / "frequency_drag.py"
_LONGEST_S = 300


def edit_ms(folder: Path, seconds: float) -> float:
    """Median of the edits of one run of the version in ``folder``, ms by the clock."""
    command = [sys.executable, str(folder / _SCRIPT), "--seconds", f"{seconds:g}"]
    # Older ones have nothing between their edits.
    if "--alone" in (folder / _SCRIPT).read_text("utf-8"):
        command.append("--alone")
    paths = os.pathsep.join(map(str, (folder / "core", folder)))
    environment = {**os.environ, "PYTHONPATH": paths, "QT_QPA_PLATFORM": "offscreen"}
    # What promises of its own it keeps is not asked here.
    completed = subprocess.run(  # noqa: S603  a script of the project
        command,
        cwd=folder,
        env=environment,
        capture_output=True,
        text=True,
        timeout=_LONGEST_S,
        check=False,
    )
    totals = [
        line.split() for line in completed.stdout.splitlines() if line.split()[:1] == ["total"]
    ]
    if len(totals) != 1:
        raise SystemExit(f"{folder} did not measure: {completed.stderr[-2000:]}")
    return float(totals[0][1])


def measure(here: Path, other: Path, seconds: float, rounds: int) -> bool:
    """Print the rounds for inputs of ``seconds``; whether the promise is kept."""
    print(f"\ninputs of {seconds:g} s, median of one edit after another, ms:")
    ratios = []
    for k in range(rounds):
        in_turn = (here, other) if k % 2 else (other, here)
        took = {folder: edit_ms(folder, seconds) for folder in in_turn}
        ratios.append(took[here] / took[other])
        print(f"  here {took[here]:6.2f}, there {took[other]:6.2f}: {ratios[-1]:.2f} x", flush=True)
    middle = statistics.median(ratios)
    holds = middle <= MOST
    print(
        f"{middle:.2f} x, from {min(ratios):.2f} to {max(ratios):.2f} (promised: {MOST:g}): "
        f"{'kept' if holds else 'BROKEN'}"
    )
    return holds


def main() -> int:
    """Measure both lengths; 1 if the promise is broken."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("other", type=Path, help="folder of the other version")
    parser.add_argument("--rounds", type=int, default=ROUNDS)
    parser.add_argument("--seconds", type=float, nargs="+", default=[1.0, 4.0])
    options = parser.parse_args()
    here, other = Path(__file__).resolve().parents[1], options.other.resolve()
    holds = [measure(here, other, seconds, options.rounds) for seconds in options.seconds]
    return int(not all(holds))


if __name__ == "__main__":
    sys.exit(main())
