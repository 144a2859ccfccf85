"""Panel of what this machine plays on."""
