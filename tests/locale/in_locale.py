"""Runs a scene in Python after setting a locale: in_locale.py LOCALE SCENE.prm. Prints what comes of it."""
import locale
import sys

locale.setlocale(locale.LC_ALL, sys.argv[1])

import debond

print(locale.localeconv()["decimal_point"], file=sys.stderr)
scene = debond.Scene(sys.argv[2], {"Interface/Characteristic slip distance": 0.0225})
print(scene.parameters)
result = scene.run()
for name, values in result.rows.items():
    print(name, [float(value) for value in values])
print({name: value for name, value in result.summary.items() if "second" not in name})
simulation = debond.Simulation(scene)
simulation.advance()
for name, values in simulation.points().items():
    print(name, [float(value) for value in values])
