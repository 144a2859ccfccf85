"""The command ``skinsource``."""
