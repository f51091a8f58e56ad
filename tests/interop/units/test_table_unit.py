"""A table of friction over speed and temperature in the units: the motion of the model."""

import numpy as np

from cosim import read_scenario, run_scenario

SPEED = (0.0, 0.1, 0.3)
MU = (0.30, 0.22, 0.18, 0.24, 0.15, 0.12, 0.10, 0.05, 0.04)


def test_a_coupled_run_has_friction_of_the_contact_s_temperature(fmu, python_fmu, tmp_path):
    """From a file over speed and temperature; the native and the Python unit alike."""
    grid = (f"{v},{t},{MU[3 * row + at]}" for row, t in enumerate((-12, -5, -4.998)) for at, v in
            enumerate(SPEED))  # fmt: skip
    (tmp_path / "mu.csv").write_text("v,T_degC,mu\n" + "\n".join(grid) + "\n")
    (tmp_path / "table.toml").write_text(
        "[rig]\nspring_natural_length = 0.17\n[initial]\nvx = 0.15\n[ambient]\n"
        'temperature_degC = -5.0\n[friction]\ntable = "mu.csv"\n[run]\nduration = 0.8\n'
    )
    scenario = read_scenario(tmp_path / "table.toml")
    native, python = (run_scenario(scenario, fmu=each).result for each in (fmu, python_fmu))
    for name in ("mechanics.x", "mechanics.heat", "thermal.interface_temperature"):
        # one kernel, two ways to run it: rounding alone
        np.testing.assert_allclose(native[name], python[name], rtol=0, atol=1e-9)
    # it warms by half of the table's last step, and slides with less than in the air's temperature
    assert native["thermal.interface_temperature"].max() > -4.999
    cold = scenario.changed({"friction.table_temperature_degC": [-12.0, -5.0, 0.0]})
    colder = run_scenario(cold, fmu=fmu).result
    assert np.abs(native["mechanics.x"] - colder["mechanics.x"]).max() > 1e-4  # of 30 mm
