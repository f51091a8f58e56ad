"""Commands that take measured or planned campaigns."""
