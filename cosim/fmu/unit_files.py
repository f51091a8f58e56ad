"""Names of the units' files, in the order in which they are told."""

NATIVE, FMI3, PYTHON = (f"StickSlip3DOF{kind}.fmu" for kind in ("", "-fmi3", "-python"))
THERMAL, THERMAL_FMI3, THERMAL_PYTHON = (
    f"BeltIceThermal{kind}.fmu" for kind in ("", "-fmi3", "-python")
)
SYSTEM = "StickSlipThermal.ssp"
UNITS = (NATIVE, FMI3, PYTHON, THERMAL, THERMAL_FMI3, THERMAL_PYTHON, SYSTEM)
