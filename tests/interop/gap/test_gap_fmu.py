"""The extended model in the FMU: it does there what the fit did, and what was measured."""

from cosim.gap.show.files import largest_difference, reproduction_line


def test_the_fmu_is_the_fitted_model(gap, fmu):
    """The fit integrates to 1e-6 of the motion's scale, the FMU to 1e-11; in noise units."""
    assert largest_difference(gap, fmu) < 1e-2
    assert "differ by less than 0.0" in reproduction_line(gap)
