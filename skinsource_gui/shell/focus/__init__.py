"""Where the keyboard goes."""
