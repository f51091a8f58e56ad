"""Measured campaigns with hidden effects, to judge `stickslip gap` by; nothing of the product."""
