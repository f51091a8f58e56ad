"""The block of ice that a set of parameters describes, and its contact with the belt."""

from typing import TypeAlias

from thermal.contact import Footprint
from thermal.parameters import ParameterError, ThermalParameters

from .cylinder import Cylinder
from .mesh_file import MeshError
from .sample import Sample

StandingBlock: TypeAlias = tuple[Footprint, Cylinder | Sample]


def standing_block(parameters: ThermalParameters) -> StandingBlock:
    """Contact and ice: a cylinder, or what a mesh file holds.

    A mesh's contact is taken as the rectangle of its area and breadth, as a disc's is. MeshError
    when the file is no such mesh, ParameterError when its contact is too long for the belt.
    """
    contact, belt = parameters.contact, parameters.belt
    if not parameters.ice.mesh:
        footprint = Footprint(contact.radius, belt.width, contact.strips, contact.length)
        return footprint, Cylinder(
            parameters.ice, contact.radius, footprint.arc_share, touching=footprint.touching
        )
    try:
        sample = Sample(parameters.ice, parameters.ice.mesh, belt.width)
    except MeshError as error:
        raise MeshError(f"ice.mesh: {error}") from error
    length = sample.area / sample.breadth
    if belt.length <= length:
        raise ParameterError(
            f"belt.length = {belt.length:g} m is shorter than the contact of"
            f" {parameters.ice.mesh}, which is {length:g} m long"
        )
    return Footprint(0.5 * sample.breadth, belt.width, contact.strips, length), sample
