"""Limits of what foreign files may declare and hold."""

#: Sample rates.
LEAST_RATE_HZ, MOST_RATE_HZ = 1.0, 768_000.0
MOST_CHANNELS = 64
#: Most columns of an array: 72 outputs along three axes are 216.
MOST_COLUMNS = 256
#: Most signals that a file may offer; the others are left out, with a note.
MOST_SERIES = 1024
#: Longest part that is imported, and most bytes of a signal after unpacking.
MOST_PART_S = 600.0
MOST_BYTES = 512 * 2**20
#: A file that declares more bytes than this, and more than so many times its size, is an attack.
SUSPICIOUS_BYTES, MOST_RATIO = 64 * 2**20, 200
MOST_TEXT_BYTES = 200 * 10**6
#: Most levels of groups within groups, or structures within structures.
MOST_DEPTH = 16
#: Samples that are read at a time.
BLOCK = 2**16
