"""52 000 damaged recordings and limbs: ``make nightly``, or ``python -m tests.nightly.mutants``.

Prints the seed, and what came of the mutants of each format and of the layout of limbs.  Ends with
1 if one was misread, or not refused in one clear sentence; what else goes wrong ends it with a
traceback.
"""

import sys
import tempfile
from functools import partial
from pathlib import Path

from skinsource.readers.reading_process import ReadingProcess
from tests.core.own_limbs.mutants import try_layout, whole_file
from tests.core.recordings.mutants import FORMATS, try_mutants
from tests.nightly.options import read_options


def main() -> int:
    options = read_options(__doc__, 52_000)
    wrong = []
    with ReadingProcess() as process, tempfile.TemporaryDirectory() as name:
        given = -(-options.count // (len(FORMATS) + 1)), options.seed, Path(name)
        tries = {kind: partial(try_mutants, kind, *given, process) for kind in FORMATS}
        tries["layout"] = partial(try_layout, whole_file(Path(name, "whole.h5")), *given, process)
        for kind, try_kind in tries.items():
            tally = try_kind()
            outcomes = ", ".join(f"{n} {part}" for part, n in tally.outcomes.most_common())
            print(f"{kind:>10}: {outcomes}; {len(tally.wrong)} wrong", flush=True)
            wrong += tally.wrong
    for line in wrong[:100]:
        print(line)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
