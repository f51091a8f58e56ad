"""Effects by which friction follows the temperature of the ice and its melt water."""
