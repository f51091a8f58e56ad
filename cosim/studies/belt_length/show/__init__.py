"""What is said and drawn of the study: the verdict in words, figures, the page."""
