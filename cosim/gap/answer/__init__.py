"""From what the search came to, to what is said of it: models in long segments, odds, laws."""
