"""Two baselines of a benchmark, compared: what is worse, and what is merely different."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "benchmarks"))
from baseline import Figure, read, write  # noqa: E402
from compare import change, main  # noqa: E402

OLD = {"step": Figure(2.0, "ms"), "peer / ours": Figure(100.0, better="more"), "error": Figure(0.0)}


def files(tmp_path, new, benchmark="heat"):
    for name, figures, of in (("old", OLD, "heat"), ("new", new, benchmark)):
        write(tmp_path / f"{name}.json", of, figures)
    return [str(tmp_path / f"{name}.json") for name in ("old", "new")]


def test_what_is_written_is_read(tmp_path):
    write(tmp_path / "made" / "old.json", "heat", OLD)
    about, figures = read(tmp_path / "made" / "old.json")
    assert about["benchmark"] == "heat" and figures == OLD
    write(None, "heat", OLD)  # nothing was asked for


def test_less_time_and_a_larger_ratio_are_better():
    assert change(Figure(2.0), Figure(3.0)) == pytest.approx(0.5)
    assert change(Figure(100.0, better="more"), Figure(50.0, better="more")) == pytest.approx(1.0)
    assert change(Figure(2.0), Figure(1.0)) < 0.0
    assert change(Figure(0.0), Figure(0.0)) == 0.0
    assert change(Figure(0.0), Figure(1e-9)) == float("inf")
    assert change(Figure(1e-9), Figure(0.0)) < 0.0


def test_the_same_is_not_worse(tmp_path, capsys):
    assert main(files(tmp_path, OLD)) == 0
    assert "worse by more" not in capsys.readouterr().out


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


def test_two_benchmarks_are_not_compared(tmp_path, capsys):
    with pytest.raises(SystemExit):
        main(files(tmp_path, OLD, "mechanics"))
    assert "heat and mechanics are not comparable" in capsys.readouterr().err
