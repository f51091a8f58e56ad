"""What the units say of themselves, read by fmpy."""

import fmpy


def test_every_variable_says_what_it_is(unit):
    description = fmpy.read_model_description(unit, validate_model_structure=True)
    units = {each.name for each in description.unitDefinitions}
    for variable in description.modelVariables:
        assert variable.description, variable.name
        if variable.type == "Real":
            assert variable.unit in units, variable.name
        if variable.causality == "parameter":
            tunable = variable.name in ("friction.mu_s", "friction.mu_k")
            assert variable.variability == ("tunable" if tunable else "fixed")
            assert variable.initial == "exact"
            assert variable.start is not None and "." in variable.name
    assert description.coSimulation.canGetAndSetFMUstate
    assert description.coSimulation.canSerializeFMUstate


def test_of_a_unit_for_co_simulation_no_output_depends_directly_on_an_input(python_fmu):
    description = fmpy.read_model_description(python_fmu)
    assert all(unknown.dependencies == [] for unknown in description.outputs)
