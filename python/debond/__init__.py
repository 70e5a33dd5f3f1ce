"""debond from Python: scenes, curves as NumPy arrays, steps that a script drives, fits to measured curves.

    import debond
    scene = debond.Scene("prm/coin_mode3_fast.prm", {"Interface/Characteristic slip distance": 0.03})
    result = scene.run()
    result.rows["torque_Nmm"].max()
    fit = debond.fit("prm/calibrate/data_set_1.prm")
    fit.table()

Units are those of scenes and of torque.csv: mm, N, N mm, MPa, degrees, s. Whatever is wrong with a scene raises SceneError
with one line that names entry and place; a load that cannot be followed raises RunError. While the library computes, other
threads of Python go on; Ctrl-C stops a run after the row at work, which is kept.
"""

import importlib
import sys
import types

# What is asked for is imported then: a page of results needs neither NumPy nor the compiled module.
_homes = {
    "scene": ("Scene", "Result", "Simulation", "sample_law", "set_number_of_threads", "__version__"),
    "errors": ("SceneError", "RunError"),
    "fit": ("fit", "Fit"),
    "calibrate": ("calibrate",),
    "ensemble": ("ensemble",),
    "executors": ("run_many",),
    "specimens": ("fit_specimens",),
}
_home_of = {name: module for module, names in _homes.items() for name in names}
__all__ = sorted(name for name in _home_of if not name.startswith("_"))


class _Package(types.ModuleType):
    """Python binds a module that is imported to its name in the package: debond.fit stays the function all the same."""

    def __setattr__(self, name, value):
        if not (name in _home_of and isinstance(value, types.ModuleType)):
            super().__setattr__(name, value)


sys.modules[__name__].__class__ = _Package


def __getattr__(name):
    if name not in _home_of:
        raise AttributeError(f"module 'debond' has no attribute {name!r}")
    value = getattr(importlib.import_module("debond." + _home_of[name]), name)
    globals()[name] = value
    return value


def __dir__():
    return sorted({*globals(), *_home_of})
