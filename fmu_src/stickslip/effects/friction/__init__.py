"""Effects that change the friction coefficient of a sliding contact, or of either."""
