"""The page on which a rig is described: what is wired to what, how strong it is, its limits."""
