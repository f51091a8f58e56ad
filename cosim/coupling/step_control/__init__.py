"""How long the macro steps are, and which of them are taken back."""
