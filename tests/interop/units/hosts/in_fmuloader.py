"""fmuloader: ``python in_fmuloader.py FILE SPEED STEP COUNT`` prints x after every step."""

import sys
import zipfile
from xml.etree.ElementTree import fromstring

from fmuloader.fmi2 import Fmi2Slave, Fmi2Type

file, speed, step, count = sys.argv[1], *map(float, sys.argv[2:])
description = fromstring(zipfile.ZipFile(file).read("modelDescription.xml"))
where = {v.get("name"): int(v.get("valueReference")) for v in description.find("ModelVariables")}
block = Fmi2Slave(file, model_identifier=description.find("CoSimulation").get("modelIdentifier"))
block.instantiate("block", Fmi2Type.CO_SIMULATION, guid=description.get("guid"))
block.setup_experiment()
block.enter_initialization_mode()
block.set_real([where["surface_speed"]], [speed])
block.exit_initialization_mode()
for n in range(int(count)):
    block.do_step(n * step, step)
    print("x", *block.get_real([where["x"]]))
block.terminate()
block.free_instance()
