"""Where ice and belt touch: the contact's size, its conductance, and what arises there."""

from stickslip.quantity import Table, quantity


class Contact(Table, strict=False):
    """Where ice and belt touch, and how well heat crosses.

    A conductance above 1e3 W/m2K changes the heat shares by less than 0.005.

    radius : radius of the ice cylinder
    length : length of a rectangular contact along the motion, as wide as the belt or the cylinder,
        the narrower; 0: the contact is the part of the cylinder's face on the belt
    conductance : contact conductance between the two faces
    wiper : part of the water and of the ice on the belt that a wiper in front of the contact takes
        off
    load : weight on the contact, which squeezes melt water out; 0: that of the ice
    belt_side : share of the friction heat that arises on the belt's face, the rest on the ice's;
        what each keeps follows from the conductance and from how both conduct
    strips : strips across the belt in each of which the flux is uniform; 1 makes the flux uniform
        over the contact
    """

    radius: float = quantity(0.04, "m", gt=0.0, le=10.0)
    length: float = quantity(0.0, "m", ge=0.0, le=20.0)
    conductance: float = quantity(1e4, "W/(m2.K)", gt=0.0, le=1e12)
    wiper: float = quantity(0.0, "1", ge=0.0, le=1.0)
    load: float = quantity(0.0, "N", ge=0.0, le=1e9)
    belt_side: float = quantity(0.5, "1", ge=0.0, le=1.0)
    strips: int = quantity(16, None, ge=1, le=64)
