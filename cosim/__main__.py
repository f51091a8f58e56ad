"""`python -m cosim`, the same as `stickslip`."""

import sys

from cosim.cli import main

sys.exit(main())
