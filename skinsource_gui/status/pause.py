"""How often what the status bar says may change."""

#: Numbers that change faster cannot be read, ms.
PAUSE_MS = 250
