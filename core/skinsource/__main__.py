"""Entry of the command ``skinsource``, also as ``python -m skinsource``."""

import sys

from skinsource.cli.command_line import main

__all__ = ["main"]

if __name__ == "__main__":
    sys.exit(main())
