"""Stick-slip coupled to the heat it makes: master, scenarios, studies and the command line.

What a program or a notebook needs is imported from here; `stickslip` and `thermal` are the two
models by themselves.

>>> from cosim import read_scenario, run_scenario
>>> scenario = read_scenario("reference").changed(rig_mass=1.2, run_duration=1.0)
>>> run = run_scenario(scenario)
>>> run["x"].shape, run.interface_temperature.attrs["units"], len(run.to_dataframe())
((101,), 'degC', 101)
>>> run.plot("temperatures")
<Figure size ... with 3 Axes>
"""

from cosim.lazy import lazy

__getattr__, __dir__, __all__ = lazy(__name__, __file__)
