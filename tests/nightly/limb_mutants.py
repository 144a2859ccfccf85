"""10 000 damaged files of limbs: ``make nightly``, or ``python -m tests.nightly.limb_mutants``.

Prints the seed, and what came of the mutants of the layout and of the files that limbs are kept in.
Ends with 1 if one was misread, or not refused in one clear sentence; what else goes wrong ends it
with a traceback.
"""

import argparse
import os
import secrets
import sys
import tempfile
from pathlib import Path

from skinsource.limbs.limb_import import LimbSource, import_limb
from skinsource.limbs.own_limbs import own_limb_path
from skinsource.readers.reading_process import ReadingProcess
from tests.core.own_limbs.mutants import try_kept, try_layout, whole_file


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=10_000, help="of both kinds together")
    parser.add_argument("--seed", type=int, default=secrets.randbelow(2**31))
    options = parser.parse_args()
    print(f"seed {options.seed}", flush=True)
    each = -(-options.count // 2)
    with ReadingProcess() as process, tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        os.environ["SKINSOURCE_DATA"] = name
        whole = whole_file(folder / "whole.h5")
        import_limb(LimbSource(responses=whole))
        tallies = {
            "layout": try_layout(whole, each, options.seed, folder, process),
            "kept": try_kept(own_limb_path("ours"), each, options.seed, folder),
        }
    for kind, tally in tallies.items():
        outcomes = ", ".join(f"{n} {part}" for part, n in tally.outcomes.most_common())
        print(f"{kind:>10}: {outcomes}; {len(tally.wrong)} wrong", flush=True)
    wrong = [line for tally in tallies.values() for line in tally.wrong]
    for line in wrong[:100]:
        print(line)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
