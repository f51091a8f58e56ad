"""Effects' files that are sent to a process elsewhere, which has one set of them in its life."""

import os
import subprocess
import sys
from pathlib import Path

from stickslip.plugins.dask_transport import packed, unpacked_call

LAW = Path(__file__).resolve().parents[2] / "examples" / "effects" / "flash_heating.py"
FAR = """
import sys
from pathlib import Path
from stickslip.plugins import PluginError, files, use
from stickslip.plugins.dask_transport import Sent, receive
text = Path(sys.argv[1]).read_text()
receive([Sent("/home/somebody/law.py", text)])
receive([Sent("/home/somebody/law.py", text)])  # with the next piece of work
use("/home/somebody/law.py")  # as a scenario does that was read there
assert [file.name for file in files()] == ["law.py"] and files()[0].is_file()
assert files()[0].read_text() == text
for others in ([Sent("/home/somebody/law.py", text + "# changed")], []):
    try:
        receive(others)
    except PluginError as error:
        print(error)
"""


def test_a_process_takes_one_set_and_refuses_another_in_one_line(tmp_path):
    done = subprocess.run(
        [sys.executable, "-c", FAR, str(LAW)],
        cwd=tmp_path, env=os.environ | {"TMPDIR": str(tmp_path)},
        capture_output=True, text=True, check=True,
    )  # fmt: skip
    assert list(tmp_path.iterdir()) == []
    changed, none = done.stdout.splitlines()
    assert changed.startswith("law.py: this worker (process ") and "started afresh" in changed
    assert none.startswith("no file: this worker")


def test_without_files_a_call_is_what_it_is_here():
    assert unpacked_call((), packed(pow, 2, 5)) == 32
