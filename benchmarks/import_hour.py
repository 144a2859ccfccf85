"""Memory of importing: 600 s of an hour at 48 kHz, within 500 MB for both processes together.

python benchmarks/import_hour.py
"""

import resource
import sys
import tempfile
from pathlib import Path

import numpy as np
import soundfile

from skinsource.design.recordings import ImportChoice, take
from skinsource.readers.reading_process import ReadingProcess

RATE_HZ, HOUR_S, PART_S = 48_000, 3600, 600.0
MOST_MB = 500.0


def main() -> int:
    with tempfile.TemporaryDirectory() as folder, ReadingProcess() as process:
        path = Path(folder) / "hour.wav"
        write_hour(path)
        choice = ImportChoice(series="0", start_s=2000.0, duration_s=PART_S)
        imported = take(path, choice, process=process)
    # Of the child it is known once it has ended.
    own, child = (
        resource.getrusage(who).ru_maxrss / 1024.0
        for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)
    )
    print(
        f"{imported.samples.duration_s:g} s taken: at most {own:.0f} MB here, {child:.0f} MB in the"
    )
    print(f"process that reads, {own + child:.0f} MB together; promised {MOST_MB:g} MB")
    return 0 if own + child <= MOST_MB else 1


def write_hour(path: Path) -> None:
    rng = np.random.default_rng(0)
    with soundfile.SoundFile(path, "w", RATE_HZ, 1, "PCM_16") as file:
        for _ in range(HOUR_S // 60):
            file.write(0.2 * rng.standard_normal(60 * RATE_HZ, np.float32))


if __name__ == "__main__":
    sys.exit(main())
