"""What tests of scenes share."""

#: The panels of the paper that can be computed.
PANELS = [
    "1C",
    "1D",
    "1E",
    "1F",
    "1G",
    "2A",
    "2B",
    "2C",
    "2D",
    "2E",
    "2F",
    "2H",
    "4A",
    "4B",
    "5A",
    "5B",
    "5D",
    "5E",
    "5F",
]
