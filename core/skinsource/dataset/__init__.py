"""The measured dataset: checking the download, the store made from it, the limbs in the store."""
