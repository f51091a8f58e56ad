"""What is looked at before an answer is believed: the record, and the numbers stated of the rig.

A fit turns every number that it may, so a rig that is not as stated, or a record that cannot hold
the motion, may come out as a missing effect, or as none. Each doubt names the run, the figure and
what would be expected of it. On campaigns that are as stated all checks together raise one in
`LEVEL` of them at most, of campaigns whose noise, zeros and set-points scatter as said.
"""

from cosim.gap.doubts.doubt import LEVEL, Doubt, hopeless, unbelieved
from cosim.gap.doubts.looked_at import doubts_of

__all__ = ["LEVEL", "Doubt", "doubts_of", "hopeless", "unbelieved"]
