"""The explorer in a browser, as somebody uses it and looks at it."""

import json
from urllib.parse import quote

import numpy as np

#: Waits in the page until the run of the address has come to its end; its columns and events.
ENDED = """
const [address, names, back] = arguments;
const before = address === null ? 0 : explorer.renewals;
if (address !== null && location.hash === address) dispatchEvent(new HashChangeEvent("hashchange"));
else if (address !== null) location.hash = address;
(function look() {
  const { run, pending, renewals } = explorer;
  const going = run && run.state !== "done" && run.state !== "refused";
  if (renewals <= before || pending || going) {
    requestAnimationFrame(look);
    return;
  }
  back(run && {
    time: [...run.time], events: run.events.map((each) => [...each]), reason: run.reason,
    columns: Object.fromEntries(names.map((name) => [name, [...run.column(name)]])),
    statistics: explorer.statistics(run), curve: [[...run.speeds], [...run.curve]],
  });
})();
"""


class Page:
    """The page of a file in a driver of Selenium."""

    def __init__(self, driver, file):
        self.driver, self.file = driver, file

    def open(self, address=""):
        """Afresh."""
        self.driver.get("about:blank")
        self.driver.get(self.file.as_uri() + address)
        return self.ended(None)

    def ended(self, address=None, names=("x",)):
        """The run when it is done, of another address if one is given."""
        found = self.driver.execute_async_script(ENDED, address, list(names))
        if found is not None:
            found["columns"] = {name: np.array(v) for name, v in found["columns"].items()}
        return found

    def tell(self, script, *arguments):
        return self.driver.execute_script(script, *arguments)

    def by_id(self, name):
        return self.driver.find_element("id", name)

    def text(self, name):
        return self.tell("return document.getElementById(arguments[0]).textContent", name)

    def faults(self):
        """What the browser complains of."""
        return [each["message"] for each in self.driver.get_log("browser")]


def address_of(preset, changes):
    """What stands behind the # of a page with these changes."""
    parts = [f"{key}={quote(json.dumps(value))}" for key, value in changes.items()]
    return "#" + "&".join([f"preset={quote(preset)}", *parts])
