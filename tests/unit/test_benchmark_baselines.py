"""Two baselines of a benchmark, compared: what is worse, and what is merely different."""

import pytest
from baseline import Figure, write
from compare import change, main

OLD = {"step": Figure(2.0, "ms"), "peer / ours": Figure(100.0, better="more"), "error": Figure(0.0)}


def files(tmp_path, new, benchmark="heat"):
    for name, figures, of in (("old", OLD, "heat"), ("new", new, benchmark)):
        write(tmp_path / f"{name}.json", of, figures)
    return [str(tmp_path / f"{name}.json") for name in ("old", "new")]


def test_less_time_and_a_larger_ratio_are_better():
    assert change(Figure(2.0), Figure(3.0)) == pytest.approx(0.5)
    assert change(Figure(100.0, better="more"), Figure(50.0, better="more")) == pytest.approx(1.0)
    assert change(Figure(2.0), Figure(1.0)) < 0.0
    assert change(Figure(0.0), Figure(0.0)) == 0.0
    assert change(Figure(0.0), Figure(1e-9)) == float("inf")
    assert change(Figure(1e-9), Figure(0.0)) < 0.0


@pytest.mark.parametrize(
    ("name", "figure"),
    [("step", Figure(2.5, "ms")), ("peer / ours", Figure(80.0, better="more"))],
)
def test_what_got_worse_is_named(tmp_path, capsys, name, figure):
    named = files(tmp_path, OLD | {name: figure})
    assert main(named) == 1
    assert f"\n  {name}: {OLD[name].value:g} -> {figure.value:g}" in capsys.readouterr().out
    assert main([*named, "--margin", "0.3"]) == 0


def test_a_figure_that_is_gone_is_worse(tmp_path, capsys):
    assert main(files(tmp_path, {"step": Figure(2.0, "ms")})) == 1
    assert "error: no longer there" in capsys.readouterr().out
