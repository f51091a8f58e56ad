"""The page of a run in Chromium: it shows the run, for every eye, hand, screen and paper."""

import base64
import re

import numpy as np
import pytest
from browser import PHONE, WIDE
from test_report_dataset import coupled_dataset

from cosim.report import write_results
from cosim.report.figures.over_time import zoom_of

LIVE = 7  # figures of a coupled run of a short belt
SMALL = 3_000_000  # bytes


@pytest.fixture(scope="module")
def page(tmp_path_factory):
    folder = tmp_path_factory.mktemp("run")
    write_results(coupled_dataset(), folder, command="stickslip run")
    return folder / "report.html"


@pytest.fixture
def opened(browser, page):
    browser.open(page)
    browser.errors()
    return browser


def bounds(browser):
    """From and to of every plot over time, s."""
    plots = "[...document.querySelectorAll('figure .plot[data-from]')]"
    ends = "(each) => [Number(each.dataset.from), Number(each.dataset.to)]"
    return np.array(browser.js(f"return {plots}.map({ends})"))


def press(browser, element, key):
    """A key, as a browser tells its page of it."""
    event = "new KeyboardEvent('keydown', {key: arguments[1], bubbles: true, cancelable: true})"
    browser.js(f"arguments[0].focus(); arguments[0].dispatchEvent({event})", element, key)


def figure(name):
    return f'figure[data-name="{name}"]'


@pytest.mark.parametrize("width", [WIDE, PHONE])
def test_it_is_small_asks_for_nothing_and_draws_everything_for_everybody(browser, page, width):
    browser.open(page, width)
    assert page.stat().st_size < SMALL
    assert browser.outside() == [] and browser.errors() == []
    assert len(browser.all("figure.live.on .stage")) == LIVE
    assert browser.overhang() <= 0 and browser.barriers() == []


def test_a_label_longer_than_its_plot_stands_above_it(opened):
    labels = [key.text.strip() for key in opened.all(f"{figure('friction_force')} .key")]
    assert labels[0] == "friction along x [N]" and all("[" in label for label in labels)


def test_pointing_tells_the_value(opened):
    dataset = coupled_dataset()
    plot = opened.one(f"{figure('motion')} .plot")
    for _ in range(3):
        press(opened, plot, "ArrowRight")
    told = opened.one(f"{figure('motion')} .key span:last-child").text
    value, unit = told.replace("−", "-").split()
    at = float(dataset["time"][-1]) * 0.53  # from the middle three hundredths on
    near = dataset["x"].sel(time=slice(at - 0.05, at + 0.05)).values
    assert unit == "mm" and 1e3 * near.min() <= float(value) <= 1e3 * near.max()


def test_zoom_by_button_and_key_goes_for_all(opened):
    dataset = coupled_dataset()
    zoom = zoom_of(dataset)
    end = float(dataset["time"][-1])
    np.testing.assert_allclose(bounds(opened), [[0.0, end]] * len(bounds(opened)))
    opened.one(f"{figure('heat')} button[aria-label^='zoom to']").click()
    np.testing.assert_allclose(bounds(opened), [[zoom.begin, zoom.end]] * len(bounds(opened)))
    plot = opened.one(f"{figure('motion')} .plot")
    press(opened, plot, "+")
    half = 0.5 * (zoom.end - zoom.begin)
    np.testing.assert_allclose(np.ptp(bounds(opened), axis=1), half)
    press(opened, plot, "Home")
    np.testing.assert_allclose(bounds(opened), [[0.0, end]] * len(bounds(opened)))


def test_a_curve_can_be_taken_away(opened):
    key = opened.one(f"{figure('heat')} .key")
    key.click()
    assert key.get_attribute("aria-pressed") == "false"
    assert opened.errors() == []


def test_the_slider_moves_the_rig(opened):
    """A key goes a row further; what stands below is the run's row."""
    dataset = coupled_dataset()
    slider = opened.one(f"{figure('top_view')} input")
    opened.js("arguments[0].value = '2'; arguments[0].dispatchEvent(new Event('input'))", slider)
    before = picture(opened)
    press(opened, slider, "ArrowRight")
    said = opened.one(f"{figure('top_view')} output").text.replace("−", "-")
    row = dataset.sel(time=2.01, method="nearest")
    x, phi = 1e3 * float(row["x"]), np.round(np.degrees(float(row["phi"])), 9)  # rounding reads 0
    assert f"t = {float(row['time']):.2f} s" in said
    assert ("slip" if row["mode"] else "stick") in said
    assert f"x = {x:.3g} mm" in said and f"φ = {phi:.3g}°" in said
    assert picture(opened) != before


def picture(browser):
    return browser.js(f"return document.querySelector('{figure('top_view')} canvas').toDataURL()")


def test_it_plays_and_pauses(opened):
    slider = opened.one(f"{figure('top_view')} input")
    opened.js("arguments[0].value = '0'; arguments[0].dispatchEvent(new Event('input'))", slider)
    # it must not come to its end before the click, however busy the machine is
    opened.js(f"document.querySelector('{figure('top_view')} select').value = '0.1'")
    press(opened, slider, " ")
    assert "pause" in opened.one(f"{figure('top_view')} button").text
    opened.until(lambda: float(slider.get_property("value")) > 0.1)
    opened.one(f"{figure('top_view')} button").click()
    stopped = slider.get_property("value")
    assert "play" in opened.one(f"{figure('top_view')} button").text
    assert slider.get_property("value") == stopped and opened.errors() == []


def test_the_belt_is_warmer_behind_the_block(opened):
    """In the first round: brighter to the right, where a belt that runs forwards goes."""
    slider = opened.one(f"{figure('top_view')} input")
    opened.js("arguments[0].value = '4'; arguments[0].dispatchEvent(new Event('input'))", slider)
    left, right = opened.js(
        f"""
        const canvas = document.querySelector('{figure("top_view")} canvas');
        const inside = canvas.getContext("2d"), row = Math.round(canvas.height * 0.42);
        const mean = (from, to) => {{
          const data = inside.getImageData(from * canvas.width, row, (to - from) * canvas.width, 1);
          return data.data.reduce((sum, v, i) => sum + (i % 4 < 3 ? v : 0), 0) / data.width;
        }};
        return [mean(0.05, 0.35), mean(0.65, 0.95)];
        """
    )
    assert right > left + 20.0


def test_paper_has_what_the_scripts_draw_without_what_is_pressed(opened):
    opened.command("Emulation.setEmulatedMedia", media="print")
    shown = opened.js(
        "return ['.stage', '.stage button:not(.key)', '.stage .key']"
        ".map((name) => [...document.querySelectorAll("
        "'figure.live ' + name)].map((each) => getComputedStyle(each).display))"
    )
    opened.command("Emulation.setEmulatedMedia", media="")
    assert set(shown[0]) == {"block"} and set(shown[1]) == {"none"}
    assert "none" not in shown[2], "they say what is drawn"


def test_a_run_is_four_pages_of_paper_at_most(opened):
    paper = {"paperWidth": 8.27, "paperHeight": 11.69}
    pdf = base64.b64decode(opened.command("Page.printToPDF", **paper)["data"])
    assert 1 <= len(re.findall(rb"/Type\s*/Page\b", pdf)) <= 4
    assert opened.js("return document.documentElement.className") == "", "a screen again"


def test_the_answer_a_picture_and_four_figures_are_the_first_screen(opened):
    first = opened.js(
        "return [...document.querySelectorAll('h1, figure, .tiles, h2')].slice(0, 4)"
        ".map((each) => [each.tagName, each.getBoundingClientRect().top])"
    )
    assert [tag for tag, _ in first] == ["H1", "FIGURE", "DIV", "H2"]
    assert first[2][1] < 900 and len(opened.all(".tiles div")) == 4
