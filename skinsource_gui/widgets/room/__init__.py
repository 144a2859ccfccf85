"""How widgets share little room: how much there is, and words in it."""
