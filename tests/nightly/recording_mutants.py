"""40 000 damaged recordings: ``make nightly``, or ``python -m tests.nightly.recording_mutants``.

Prints the seed, and what came of the mutants of each format.  Ends with 1 if one was misread or
not refused in one clear sentence; what else goes wrong ends it with a traceback.
"""

import argparse
import secrets
import sys
import tempfile
from pathlib import Path

from skinsource.readers.reading_process import ReadingProcess
from tests.core.recordings.mutants import FORMATS, try_mutants


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=40_000, help="of all formats together")
    parser.add_argument("--seed", type=int, default=secrets.randbelow(2**31))
    options = parser.parse_args()
    print(f"seed {options.seed}", flush=True)
    wrong = []
    each = -(-options.count // len(FORMATS))
    with ReadingProcess() as process, tempfile.TemporaryDirectory() as folder:
        for file_format in FORMATS:
            tally = try_mutants(file_format, each, options.seed, Path(folder), process)
            outcomes = ", ".join(f"{n} {part}" for part, n in tally.outcomes.most_common())
            print(f"{file_format:>10}: {outcomes}; {len(tally.wrong)} wrong", flush=True)
            wrong += tally.wrong
    for line in wrong[:100]:
        print(line)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
