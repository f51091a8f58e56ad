"""Write hidden campaigns: `cd tests && python -m blind FOLDER ANSWERS --kind effects --count 3`."""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np

from .campaign import KINDS, SIZES, draw_campaign
from .effects import EFFECTS
from .out_of_catalogue import OUT_OF_CATALOGUE
from .plug_ins import PLUG_INS
from .writing import write_campaign


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path, help="campaigns, one folder each")
    parser.add_argument("answers", type=Path, help="answers, one JSON file each")
    parser.add_argument("--kind", choices=KINDS, default="effects")
    parser.add_argument("--count", type=int, default=1)
    parser.add_argument("--seed", type=int, help="of the first; drawn afresh if left out")
    parser.add_argument(
        "--hide", nargs="*", default=[], choices=[*EFFECTS, *OUT_OF_CATALOGUE, *PLUG_INS]
    )
    parser.add_argument("--sizes", nargs=2, type=float, default=SIZES, help="noise units")
    told = parser.parse_args()
    first = told.seed
    if first is None:
        first = int(np.random.SeedSequence().generate_state(1)[0])
    for seed in range(first, first + told.count):
        made = draw_campaign(seed, told.kind, told.hide, tuple(told.sizes))
        name = f"c{seed}"
        answer = write_campaign(made, told.folder / name, told.answers / f"{name}.json", name)
        print(f"{name}: {answer['size']['largest']:.1f} noise units, seed {seed}")


if __name__ == "__main__":
    main()
