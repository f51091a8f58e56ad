"""What those share who need the executed tutorials."""

import os

import pytest


@pytest.fixture(scope="session")
def executed(tmp_path_factory):
    """Page -> its executed notebook, each executed once for all workers."""
    from build_site import environment  # the packages that build the site: only for who asks
    from notebooks import Executed

    base = tmp_path_factory.getbasetemp()
    # a worker's folder lies in that of all
    folder = base.parent if "PYTEST_XDIST_WORKER" in os.environ else base
    return Executed(folder / "notebooks", environment(tmp_path_factory.mktemp("shell")))
