"""The catalogue printed, as JSON and as a page: every effect is there, and shows."""

import json

import numpy as np
import pytest
from command_line import refusal
from stickslip import EFFECTS
from stickslip.catalogue import CATALOGUE

from cosim.cli import main
from cosim.report.style import shown
from cosim.studies.effects import page as effects_page

IDS = [entry.id for entry in EFFECTS]
ENTRIES = [effects_page.Entry(effect, CATALOGUE) for effect in EFFECTS]


@pytest.mark.parametrize("entry", ENTRIES, ids=IDS)
def test_the_case_shows(entry):
    """The motion differs by more than a tenth of its swing: the figure has something to say."""
    plain, shown = (effects_page.motion(entry, on) for on in (False, True))
    begin, end = entry.effect.case.window
    assert plain.time[-1] == shown.time[-1] == end  # neither run gave up
    assert np.max(np.abs(plain["x"] - shown["x"])) > 0.1 * np.ptp(plain["x"])
    aside = entry.effect.id in ("lateral_friction", "turning_surface", "spring_misalignment")
    assert aside == bool({"y", "phi"} & set(effects_page.channels_shown(entry)))


def test_command(tmp_path, capsys):
    folder = tmp_path / "out"
    assert main(["effects", "run_in", "temperature_dependence", "-o", str(folder)]) == 0
    assert "run_in.change [1] = 0, allowed [-0.95, 5], typical" in capsys.readouterr().out
    html = (folder / "effects.html").read_text(encoding="utf-8")
    assert html.count('<figure class="live"') == 2 and "http" not in html
    assert html.count("data:image/png;base64,") == 2, "the laws"
    assert "<h1>2 effects can be added to the plain model: 2 of friction.</h1>" in html
    assert html.count('<details class="index"><summary>') == 2, "an index that folds"
    assert (folder / "run_in.png").read_bytes().startswith(b"\x89PNG")
    assert main(["effects", "--json"]) == 0
    entries = json.loads(capsys.readouterr().out)
    assert [entry["id"] for entry in entries] == IDS
    assert all(parameter["unit"] for entry in entries for parameter in entry["parameters"])


def test_all_effects_are_seen_at_a_glance():
    """A panel each, with two curves: nobody has to unfold them to compare."""
    seen = [ax for ax in shown(effects_page.draw_overview, ENTRIES).axes if ax.get_visible()]
    assert [ax.get_title(loc="left") for ax in seen] == IDS
    assert all(len(ax.lines) >= 2 for ax in seen)


@pytest.mark.parametrize("drawn", [0, 1])
def test_what_was_drawn_before_ctrl_c_is_kept(tmp_path, capsys, monkeypatch, drawn):
    effect_figure = effects_page.effect_figure

    def interrupted(entry):
        if entry.effect.id == "run_in" or not drawn:
            raise KeyboardInterrupt
        return effect_figure(entry)

    monkeypatch.setattr(effects_page, "effect_figure", interrupted)
    assert main(["effects", "run_in", "film_drag", "-o", str(tmp_path)]) == 1
    out, err = capsys.readouterr()
    assert (out, err) == ("", f"error: interrupted; {drawn} of 2 figures are in {tmp_path}\n")
    assert len(list(tmp_path.glob("*.png"))) == drawn


def test_unknown_effect(capsys):
    assert "nearest known: velocity_weakening" in refusal(capsys, "effects", "velocity_weakning")
