"""Writes the measured figures of the verification tests: `python tests/docs/measure.py`.

It runs tests/verification once more, with every assertion that passes shown to this file, which is
a plugin of pytest then; site/reference/verification.json is what the site's table is made from.
Arguments go to pytest (`-n 2`); where they name tests, these alone are measured anew. The suite
itself does nothing of this.
"""

import json
import os
import platform
import re
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from datetime import date
from importlib.metadata import version
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
FIGURES = HERE / "site" / "reference" / "verification.json"
NUMBER = r"(?:np\.(?:float|int)\d+\()?(-?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?)\)?"
BELOW = re.compile(rf"{NUMBER} (<=?) {NUMBER}")
ABOVE = re.compile(rf"{NUMBER} (>=?) {NUMBER}")
NEAR = re.compile(rf"{NUMBER} == {NUMBER} ± {NUMBER}")
#: Of what a test has added to its report.
KEY = "figure"
#: What Hypothesis asserts of its own examples.
NOT_OURS = "valid_test_cases"

Figure = tuple[float, str, str, str]  # part of what is allowed, expression, measured, allowed


def figure_of(expression: str, explained: str) -> Figure | None:
    """The figure of an assertion that passed, None where it compares no two numbers.

    >>> figure_of("error < 1e-9", "3.217e-13 < 1e-09")[2:]
    ('3.22e-13', '< 1e-09')
    >>> figure_of("x == approx(2, abs=1)", "2.5 == 2 ± 1")[0]
    0.5
    """
    first = explained.split("\n")[0]
    if found := NEAR.fullmatch(first):
        value, wanted, allowed = map(float, found.groups())
        part = abs(value - wanted) / allowed if allowed else 0.0
        measured = f"{value:.6g}, off by {abs(value - wanted):.2g}"
        return part, _left(expression), measured, f"{wanted:.6g} ± {allowed:.2g}"
    if found := BELOW.fullmatch(first):
        value, limit = float(found[1]), float(found[3])
        return _part(value, limit), _left(expression), f"{value:.3g}", f"{found[2]} {limit:.3g}"
    if found := ABOVE.fullmatch(first):
        value, limit = float(found[1]), float(found[3])
        # mostly that there was something to look at: an error beside it says more
        return -0.5, _left(expression), f"{value:.3g}", f"{found[2]} {limit:.3g}"
    return None


def _part(small: float, large: float) -> float:
    return abs(small / large) if large else 0.0


def _left(expression: str) -> str:
    """What is compared, without what with."""
    return re.split(r" (?:[<>]=?|==) ", " ".join(expression.split()))[0]


def pytest_assertion_pass(item, orig, expl):
    """pytest: an assertion held."""
    if NOT_OURS not in orig and (found := figure_of(orig, expl)):
        item.user_properties.append((KEY, found))


def pytest_configure(config):
    """pytest: the process that hears of every test collects."""
    if not hasattr(config, "workerinput"):
        config.pluginmanager.register(Collected())


class Collected:
    """Of each test function the figure that is nearest to what is allowed."""

    def __init__(self):
        self.files: dict[str, dict[str, Figure]] = {}
        self.failed: set[str] = set()

    def pytest_runtest_logreport(self, report):
        """pytest: set-up, call or tear-down of a test ended."""
        path, _, test = report.nodeid.partition("::")
        file, name = "/".join(Path(path).parts[-2:]), test.partition("[")[0]
        if report.failed:
            self.failed.add(f"{file}: {name}")
        if report.when != "call" or not report.passed:
            return
        tests = self.files.setdefault(file, {})
        figures = [tuple(value) for key, value in report.user_properties if key == KEY]
        tests[name] = max([*figures, tests.get(name, (-1.0, "", "passed", ""))])

    def pytest_sessionfinish(self, session):
        """pytest: all tests ended."""
        made = {
            "date": date.today().isoformat(),
            "version": version("stickslip"),
            "python": platform.python_version(),
            "machine": f"{platform.system()} {platform.machine()}",
        }
        files = {
            file: {test: figure[1:] for test, figure in tests.items()}
            for file, tests in sorted(self.files.items())
        }
        failed = self.failed
        if tests_named(session.config.args):
            before = json.loads(FIGURES.read_text(encoding="utf-8"))
            measured = {f"{file}: {test}" for file, tests in files.items() for test in tests}
            failed = failed | (set(before["failed"]) - measured)
            files = before["files"] | {
                file: before["files"].get(file, {}) | tests for file, tests in files.items()
            }
        figures = {"made": made, "failed": sorted(failed), "files": files}
        FIGURES.write_text(json.dumps(figures, indent=1, ensure_ascii=False) + "\n", "utf-8")


def tests_named(arguments: Sequence[str]) -> bool:
    """Whether some of the tests are asked for, not all."""
    return any("tests/verification/" in argument for argument in arguments)


def main() -> int:
    """Run the verification tests with this file as a plugin; the exit status of pytest."""
    with tempfile.TemporaryDirectory() as cache:
        environment = os.environ | {
            "PYTHONPATH": os.pathsep.join([str(HERE), os.environ.get("PYTHONPATH", "")]),
            # assertions are compiled otherwise than in the suite
            "PYTHONPYCACHEPREFIX": cache,
        }
        command = [sys.executable, "-m", "pytest", "-q", "-p", "measure"]
        command += ["-o", "enable_assertion_pass_hook=true", *sys.argv[1:]]
        command += [] if tests_named(sys.argv) else ["tests/verification"]
        return subprocess.run(command, cwd=ROOT, env=environment).returncode


if __name__ == "__main__":
    sys.exit(main())
