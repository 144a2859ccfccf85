"""The engine: from a design to quantities, by rules that compute what is asked for."""
