"""What the skin should feel, and how near the drives come to it."""
