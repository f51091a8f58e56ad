"""What a user may say in a scenario file, and what is wrong with it."""

from cosim.lazy import lazy

# who only refuses a wrong key needs no model
__getattr__, __dir__, __all__ = lazy(__name__, __file__)
