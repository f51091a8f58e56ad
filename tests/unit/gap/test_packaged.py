"""The campaigns that ship with the package are found by their names."""

from cosim.cli.measurements.gap import packaged_campaigns


def test_the_study_is_one():
    assert "study" in packaged_campaigns()
