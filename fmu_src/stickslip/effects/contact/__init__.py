"""Effects that change what a contact at rest holds."""
