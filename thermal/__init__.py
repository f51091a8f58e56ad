"""Heat in belt and ice."""

from .model import BeltIceModel
from .parameters import Ambient, Belt, Contact, Ice, ThermalParameters

__all__ = ["Ambient", "Belt", "BeltIceModel", "Contact", "Ice", "ThermalParameters"]
