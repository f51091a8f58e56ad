"""What a belt is: its layers, what it gives to the air, and what it runs over."""

from stickslip.quantity import Table, quantity

from .air import moving_belt


class Layer(Table, strict=False):
    """One layer of a belt.

    thickness : thickness
    density : density
    heat_capacity : specific heat capacity
    conductivity : thermal conductivity
    """

    thickness: float = quantity(..., "m", gt=0.0, le=0.1)
    density: float = quantity(..., "kg/m3", gt=0.0, le=3e4)
    heat_capacity: float = quantity(..., "J/(kg.K)", gt=0.0, le=1e5)
    conductivity: float = quantity(..., "W/(m.K)", gt=0.0, le=1e4)


class Belt(Table, strict=False):
    """An endless belt, one homogeneous layer unless `layers` says otherwise.

    Length, width and mass per length (0.0525 kg/m at 75 mm) are those of the sanding belt of
    the test rig; 840 J/kgK is the source study's figure. Conductivity of paper and cloth
    backed abrasive lies in 0.25 ... 2 W/mK and was not measured. 5 ... 25 W/m2K is still air
    to a light draught; the study's rate of 0.25 1/s would need 73.5 W/m2K.

    A railing carries the belt below the ice, rollers turn it: where they touch the back, they
    take the place of the air, at the air's temperature unless the rollers are warmer. A railing of
    conductance 0 only covers. The belt rubs on its railing under the block's weight; the part of
    that heat that enters the belt does so evenly along the railing, the rest is the railing's.

    length : length of the loop
    width : width
    thickness : thickness
    density : density
    heat_capacity : specific heat capacity
    conductivity : thermal conductivity
    air_heat_transfer : heat transfer to the air, on each free face
    still_air_speed : speed of the belt through still air, from which its heat transfer then follows
        in place of air_heat_transfer; 0: that number holds
    layers : layers from the contact face to the back, in place of thickness, density, heat_capacity
        and conductivity
    railing_length : length of the railing along the belt, its middle below the contact's; 0: none
    railing_conductance : from the back of the belt to the railing
    railing_friction : coefficient of friction of the belt on its railing; 0: none; PTFE 0.04 to 0.2
    railing_load : load of the belt on its railing; 0: the block's weight in a scenario, none where
        there is no block
    railing_share : share of the railing's friction heat that enters the belt
    rollers : rollers, evenly spread from half a spacing after the contact
    roller_arc : length of belt that touches a roller; half the circumference of a 64 mm one
    roller_conductance : from the back of the belt to a roller
    roller_rise : rollers above the air, warmed by their drive and by flexing the belt
    elements : P2 elements through the thickness, finest at the contact
    cell_length : length of a cell along the belt; rounded to fit the loop
    """

    length: float = quantity(1.0, "m", gt=0.0, le=100.0)
    width: float = quantity(0.075, "m", gt=0.0, le=10.0)
    thickness: float = quantity(1e-3, "m", gt=0.0, le=0.1)
    density: float = quantity(700.0, "kg/m3", gt=0.0, le=3e4)
    heat_capacity: float = quantity(840.0, "J/(kg.K)", gt=0.0, le=1e5)
    conductivity: float = quantity(0.5, "W/(m.K)", gt=0.0, le=1e4)
    air_heat_transfer: float = quantity(15.0, "W/(m2.K)", ge=0.0, le=1e4)
    still_air_speed: float = quantity(0.0, "m/s", ge=0.0, le=1e3)
    layers: tuple[Layer, ...] = quantity((), None, max_length=10)
    railing_length: float = quantity(0.0, "m", ge=0.0, le=100.0)
    railing_conductance: float = quantity(0.0, "W/(m2.K)", ge=0.0, le=1e12)
    railing_friction: float = quantity(0.0, "1", ge=0.0, le=10.0)
    railing_load: float = quantity(0.0, "N", ge=0.0, le=1e6)
    railing_share: float = quantity(0.5, "1", ge=0.0, le=1.0)
    rollers: int = quantity(0, None, ge=0, le=20)
    roller_arc: float = quantity(0.1, "m", gt=0.0, le=100.0)
    roller_conductance: float = quantity(100.0, "W/(m2.K)", ge=0.0, le=1e12)
    roller_rise: float = quantity(0.0, "K", ge=-100.0, le=100.0)
    elements: int = quantity(6, None, ge=1, le=40)
    cell_length: float = quantity(1e-3, "m", gt=0.0, le=1.0)

    @property
    def cells(self) -> int:
        """Cells along the loop, at least eight."""
        return max(8, round(self.length / self.cell_length))

    @property
    def film(self) -> float:
        """Heat transfer to the air on each free face, W/m2K: given, or of a moving belt.

        The belt's spans between its rollers are half a loop; air at -8 degC, since 8 K change
        it by 3 %, and a belt 1 K warmer than it: a scenario knows what warms it, and takes
        `air.heated_belt`.
        """
        if self.still_air_speed == 0.0:
            return self.air_heat_transfer
        return moving_belt(self.still_air_speed, 0.5 * self.length, width=self.width)

    @property
    def stack(self) -> tuple[Layer, ...]:
        """The layers, one of the belt's own properties when none are given."""
        own = {name: getattr(self, name) for name in Layer.model_fields}
        return self.layers or (Layer(**own),)

    @property
    def capacity_per_area(self) -> float:
        """Heat capacity of the belt per area, J/m2K."""
        return sum(layer.thickness * layer.density * layer.heat_capacity for layer in self.stack)
