"""Nothing is lost: copies of unsaved work, locks on open files, and a log of crashes."""
