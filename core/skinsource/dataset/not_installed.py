"""What is said where the measured limbs are missing."""

NOT_INSTALLED = "The measured limbs are not installed."
HOW_TO_GET = (
    "Get them with 'skinsource dataset fetch' (downloads 70 MB), or, from files you already have, "
    "with 'skinsource dataset install PATH'."
)
