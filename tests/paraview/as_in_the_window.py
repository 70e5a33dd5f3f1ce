"""Runs open_results.py as ParaView's window runs scripts, by DEBOND_RESULTS and by the series that is selected."""

import os
import sys

sys.dont_write_bytecode = True
source = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../doc/paraview")
sys.path.insert(0, source)
from open_results import run_with_a_screen

if not os.environ.get("DISPLAY"):
    sys.exit(run_with_a_screen())
from paraview import simple

with open(os.path.join(source, "open_results.py"), encoding="utf-8") as file:
    script = file.read()
sys.argv = [""]
exec(script, {"__name__": "__main__"})
layouts = len(simple.GetLayouts())
results = os.environ.pop("DEBOND_RESULTS")
simple.PVDReader(FileName=os.path.join(results, "interface.pvd"))
exec(script, {"__name__": "__main__"})
times = list(simple.GetAnimationScene().TimeKeeper.TimestepValues)
good = layouts == 1 and len(simple.GetLayouts()) == 2 and len(times) == 3 and max(times) == 4
print("as in the window: %s" % ("yes" if good else "NO, layouts %s, times %s" % (simple.GetLayouts(), times)))
# without taking views down, at which ParaView may fail
sys.stdout.flush()
os._exit(not good)
