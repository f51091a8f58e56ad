"""Frames a second of the explorer's page in Chromium, and how soon a turned number is a whole run.

    python tests/benchmarks explorer_frames [SECONDS]

Played, and while numbers of the rig are turned all the time. Without a window and without a
graphics card, so a screen does no worse. What a frame costs in processor time does not depend on
what else the machine does: below 33 ms, a core of its own makes 30 frames a second. Needs
selenium, psutil, chromium and chromedriver.
"""

import shutil
import sys
import tempfile
from operator import sub
from pathlib import Path

import psutil
from selenium import webdriver

from cosim.cli import main

#: Turns the mass up and down at every frame (or leaves it), and counts frames and runs.
WATCH = """
const [seconds, turning, back] = arguments;
const begun = performance.now();
const times = [], wishes = new Map(), took = [];
(function each(now) {
  times.push(now);
  const run = explorer.run;
  if (run && !wishes.has(run.number)) wishes.set(run.number, now);
  if (run && run.state === "done" && wishes.get(run.number) !== null) {
    took.push(now - wishes.get(run.number));
    wishes.set(run.number, null);
    if (turning) explorer.set("rig.mass", 0.6 + 0.2 * Math.sin(now / 500));
  }
  if (now - begun < 1000 * seconds) requestAnimationFrame(each);
  else back({ times, took });
})(begun);
"""
PLAYED = {
    "played": ("", False),
    "reference turned": ("", True),
    "slab turned": ("#preset=slab", True),
    "scatter turned": ("#preset=reference&surface_scatter.deviation=0.1", True),
    "5 s shown, played": ("", False),
}


def measure(seconds: float) -> None:
    """Prints a line for each way to use the page."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "explorer.html"
        main(["explore", "--no-open", "-o", str(file)])
        print(f"page: {file.stat().st_size / 1e3:.0f} kB")
        options = webdriver.ChromeOptions()
        options.binary_location = shutil.which("chromium") or ""
        for argument in ("headless=new", "no-sandbox", "disable-gpu", "window-size=1400,1000"):
            options.add_argument(f"--{argument}")
        service = webdriver.ChromeService(shutil.which("chromedriver"))
        driver = webdriver.Chrome(options=options, service=service)
        driver.set_script_timeout(seconds + 60.0)
        driver.execute_cdp_cmd("Performance.enable", {"timeDomain": "threadTicks"})
        try:
            for name, (address, turning) in PLAYED.items():
                driver.get("about:blank")
                driver.get(file.as_uri() + address)
                if name.startswith("5 s"):
                    driver.execute_script(
                        "const span = document.getElementById('span'); span.value = '5';"
                        "span.dispatchEvent(new Event('change'))"
                    )
                before = processor_time(driver)
                found = driver.execute_async_script(WATCH, seconds, turning)
                own, all_of_it = map(sub, processor_time(driver), before)
                report(name, found, own, all_of_it)
        finally:
            driver.quit()


def processor_time(driver: webdriver.Chrome) -> tuple[float, float]:
    """Processor time of the page's own thread, and of all of the browser's processes, s."""
    metrics = driver.execute_cdp_cmd("Performance.getMetrics", {})["metrics"]
    own = next(each["value"] for each in metrics if each["name"] == "ThreadTime")
    family = psutil.Process(driver.service.process.pid).children(recursive=True)
    times = [each.cpu_times() for each in family]
    return own, sum(each.user + each.system for each in times)


def report(name: str, found: dict[str, list[float]], own: float, all_of_it: float) -> None:
    """Mean frames a second, the slowest hundredth, a frame's cost, the time from turn to run."""
    times, took = found["times"], sorted(found["took"])
    gaps = sorted(b - a for a, b in zip(times, times[1:], strict=False))
    rate = 1e3 * len(gaps) / (times[-1] - times[0])
    late = gaps[int(0.99 * len(gaps))]
    middle = took[len(took) // 2] if took else float("nan")
    page, browser = (1e3 * each / len(gaps) for each in (own, all_of_it))
    print(
        f"{name:20s} {rate:5.1f} frames a second, 99 % within {late:.0f} ms; processor: "
        f"page {page:.1f} ms a frame, browser {browser:.0f} ms; "
        f"{len(took)} runs, {middle:.0f} ms each"
    )


if __name__ == "__main__":
    measure(float(sys.argv[1]) if len(sys.argv) > 1 else 5.0)
