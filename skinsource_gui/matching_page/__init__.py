"""The page on which a person makes vibrations equally strong."""
