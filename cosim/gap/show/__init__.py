"""The answer shown: numbers, words, figures, a page, and the extended model as a file."""
