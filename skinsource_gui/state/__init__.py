"""What the studio knows: the document, the engine, the preferences."""
