"""What is run at night says how much of it, and with which seed."""

import argparse
import secrets


def read_options(about: str | None, count: int) -> argparse.Namespace:
    """Read ``--count`` and ``--seed``, and print the seed, with which all of it can be repeated."""
    parser = argparse.ArgumentParser(description=about)
    parser.add_argument("--count", type=int, default=count)
    parser.add_argument("--seed", type=int, default=secrets.randbelow(2**31))
    options = parser.parse_args()
    print(f"seed {options.seed}", flush=True)
    return options
