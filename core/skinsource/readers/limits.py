"""How much of a foreign file is believed."""

#: Samples a second.
LEAST_RATE_HZ, MOST_RATE_HZ = 1.0, 768_000.0
MOST_CHANNELS = 64
#: Of an array: 72 outputs along three axes are 216.
MOST_COLUMNS = 256
#: Signals that a file may offer; what comes after them is left out, with a note.
MOST_SERIES = 1024
#: Of what is taken, and of a signal that is only kept compressed.
MOST_PART_S = 600.0
MOST_BYTES = 512 * 2**20
#: A file that declares more than this and more than so many times what it holds means harm.
SUSPICIOUS_BYTES, MOST_RATIO = 64 * 2**20, 200
MOST_TEXT_BYTES = 200 * 10**6
#: Groups within groups, structures within structures.
MOST_DEPTH = 16
#: Samples that are read at once.
BLOCK = 2**16
#: Of the process that reads.
MEMORY_BYTES = 2**30
