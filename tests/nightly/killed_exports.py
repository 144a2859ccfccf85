"""300 exports that are killed: ``make nightly``, or ``python -m tests.nightly.killed_exports``.

Prints the seed, and which files were left half written under their final names.  Ends with 1 if
there was one.
"""

import argparse
import json
import secrets
import subprocess
import sys
import tempfile
from pathlib import Path

PROGRAM = Path(__file__).parents[1] / "core" / "exporting" / "killed_exports.py"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--kills", type=int, default=300)
    parser.add_argument("--seed", type=int, default=secrets.randbelow(2**31))
    options = parser.parse_args()
    print(f"seed {options.seed}", flush=True)
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run(
            [sys.executable, str(PROGRAM), folder, str(options.kills), str(options.seed)],
            check=True,
            capture_output=True,
            text=True,
        )
    counts = json.loads(done.stdout)
    print(
        f"{counts['kills']} kills, {len(counts['broken'])} broken: {counts['broken']}", flush=True
    )
    return 1 if counts["broken"] else 0


if __name__ == "__main__":
    sys.exit(main())
