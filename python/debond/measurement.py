"""What an instrument has written, as a fit uses it: which columns, which rows, and how large their noise is said to be."""

from dataclasses import dataclass, field

import numpy

import _debond

from . import measured
from .errors import InputError, RunError
from .measured import CURVE_ENTRY as ENTRY


@dataclass(frozen=True)
class CurveColumn:
    """A quantity that is measured: the time, or a reaction or position of the chuck."""

    name: str  # as a column of torque.csv
    key: str  # column of the rows of a run
    kind: str  # "time", "load" or "position"
    unit: str
    component: int = -1  # 0..5 of the chuck

    is_angle = property(lambda self: self.kind == "position" and self.component == 5)
    is_torque = property(lambda self: self.kind == "load" and self.component == 5)
    # of the rows of a run: the load along or about the axis of a position
    load = property(lambda self: "torque_Nmm" if self.component == 5 else _debond.chuck_columns[self.component][1])


def curve_column(scene, name, entry):
    """Raises SceneError that names the `entry` of the scene."""
    if name == "time":
        return CurveColumn(name, name, "time", "")
    for machine, unit, k in (("machine_angle_deg", "deg", 5), ("machine_uz_mm", "mm", 2)):
        if name == machine:
            return CurveColumn(name, name, "position", unit, k)
    for position, load, unit, load_unit, k in _debond.chuck_columns:
        if name == position or (k == 5 and name == "angle_deg"):
            return CurveColumn(name, position, "position", unit, k)
        if name == load or (k == 5 and name == "torque_Nmm"):
            return CurveColumn(name, "torque_Nmm" if name == "torque_Nmm" else load, "load", load_unit, k)
    scene.refuse(entry, "there is no such curve: expected time, angle_deg, torque_Nmm, machine_angle_deg, machine_uz_mm or a column "
                        "of torque.csv that begins with chuck_")


def branches_of(over, least):
    """Between which turning points each value lies, 0 before the first. A curve turns where it goes back by more than `least`
    of its range."""
    branch, steps = numpy.zeros(len(over), dtype=int), numpy.diff(over)
    if (steps >= 0).all() or (steps <= 0).all():
        return branch
    tolerance = least * (over.max() - over.min())
    direction = n = extreme = 0
    for i, moved in enumerate(over):
        moved -= over[extreme]
        if direction == 0 and abs(moved) > tolerance:
            direction = 1 if moved > 0 else -1
        if direction * moved >= 0:
            extreme = extreme if direction == 0 else i
        elif abs(moved) > tolerance:
            n += 1
            branch[extreme + 1:i] = n
            direction, extreme = -direction, i
        branch[i] = n
    return branch


def direction_of(values, branch):
    """+1 or -1: which way values go before they turn for the first time; 0 if they stay."""
    way = [(-1) ** b * (values[branch == b][-1] - values[branch == b][0]) for b in numpy.unique(branch)]
    return next((1 if one > 0 else -1 for one in way if one != 0), 0)


def branches_like(x, measured, least_turn):
    """Between which turning points each place of a computed curve lies that is measured at the places, with the branches, of the
    pair `measured`. Raises RunError if it turns less often."""
    branch, (over, own) = branches_of(x, least_turn), measured
    if direction_of(x, branch) * direction_of(over, own) < 0 and branch[-1] > own[-1]:
        branch = branch - 1  # a bond is pressed before it is pulled, and the file begins with the pull
    if len(own) and branch[-1] < own[-1]:
        raise RunError(f"the measured curve turns back {own[-1]} times, the scene {branch[-1]} times: leave out the rows behind the turn, "
                       "or let the load of the scene turn back, too")
    return branch


@dataclass
class Measurement:
    """Rows of a measured curve, in the order of the file."""

    file: str  # empty: nothing has been measured yet
    over: numpy.ndarray  # where (n)
    values: numpy.ndarray  # n x curves, in the units of the scene
    branch: numpy.ndarray  # of each row, between turning points
    least_turn: float  # by which part of its range a curve goes back where it turns
    scale: numpy.ndarray  # of each curve: its largest magnitude
    sd: numpy.ndarray = None  # n x curves: of the noise, as it was stated; None: not stated
    parts: list = field(default_factory=list)  # slices of rows without a gap of the windows
    share: numpy.ndarray = None  # of each row: how much of the rows of the file is over
    signs: list = field(default_factory=list)  # of `over` and the curves: -1 where Reference columns have a minus
    counts: dict = field(default_factory=dict)  # rows of the file: all, used, and why others are not
    remarks: list = field(default_factory=list)  # what may be wrong with the file
    is_prescribed: bool = True  # by the scene, which so says how far it comes
    said: str = ""  # which columns have been read


def rows_in_words(measured):
    counts = measured.counts
    why = {"outside_windows": "outside the windows", "at_rest_or_turns": "where the row before was, or at a turn",
           "beyond_scene": "beyond what the scene comes to"}
    return f"{measured.file}: {measured.said}: {counts['used']} of {counts['rows']} rows are fitted" + "".join(
        f"; {counts[key]} are {text}" for key, text in why.items() if counts[key])


def unit_doubt(name, unit, measured, computed, where, factor):
    """A question if the largest values of a file and of a curve are further apart than by a factor; else nothing."""
    return "" if computed / factor < measured < computed * factor else (
        f"the largest {name} is {measured:.4g} {unit} in the file and {computed:.4g} in the {where}: is its unit right?")


def given(text):
    """The text of an entry; nothing if it is `auto` or `none`."""
    return "" if text in ("auto", "none") else text


def _list_of(text):
    return [item.strip() for item in given(text).split(",") if item.strip()]


def numbers_of(values, name):
    return [float(item) for item in _list_of(values["Calibration / " + name])]


def stated_noise(values):
    """Standard deviations relative to the largest value; [0] if the scene states none."""
    return numbers_of(values, "Noise") or [0.0]


def _places(scene, over, times):
    """The place along `over` at each of `times`, as far as the scene prescribes it; else None."""
    times = numpy.asarray(times, dtype=float)
    if over.kind == "time":
        return times
    # by what a compliant machine does; the implant moves less
    return scene.prescribed(list(times)).get(_debond.chuck_columns[over.component][0]) if over.kind == "position" else None


def _least_turn(places):
    """Measured places are not smooth: what goes back by less than a twentieth of the range is no turn, unless the scene, which
    comes to these places, turns by less."""
    usual = 0.05
    if places is None or numpy.ptp(places) == 0:
        return usual
    branch = branches_of(places, 1e-9)
    turns = numpy.flatnonzero(numpy.diff(branch))
    ends = numpy.r_[0, turns, len(places) - 1]
    return min(usual, 0.4 * numpy.abs(numpy.diff(places[ends])).min() / numpy.ptp(places)) if len(turns) else usual


def _reach(places, largest_shift):
    """What a scene comes to, with all that the rig may show more: rows beyond mean nothing."""
    if places is None:
        return -numpy.inf, numpy.inf
    margin = 1e-9 * numpy.ptp(places)
    return places.min() - margin - largest_shift, places.max() + margin + largest_shift


def _with_other_sign(choice, table, columns, over):
    """What turns the places of a file, and the load along them if both go together: a load that moves something does work."""
    work = ((table[1:, 1:] + table[:-1, 1:]) * numpy.diff(table[:, :1], axis=0)).sum(axis=0)
    turns = [True, *(column.kind == "load" and column.component == over.component and w >= 0 for column, w in zip(columns, work))]
    return ", ".join(item.replace("[", "[-").replace("[--", "[") if turn else item for item, turn in zip(choice, turns))


def _used_rows(scene, values, columns, over, table, choice, branch, reach, compliance):
    """Numbers of the rows that are fitted, of each the window that it is in, and how many there are: all, used, and why others
    are not."""
    places = table[:, 0]
    implant = places.copy()  # where the implant is while the machine shows that place
    for c, column in enumerate(columns):
        if column.kind == "load" and over.kind == "position" and column.component == over.component:
            implant -= compliance * table[:, c + 1]
    bounds = numbers_of(values, "Windows")
    windows = list(zip(bounds[::2], bounds[1::2])) or [(-numpy.inf, numpy.inf)]
    window = numpy.full(len(places), -1)
    for w, (begin, end) in reversed(list(enumerate(windows))):
        window[(places >= begin) & (places <= end)] = w
    least, most = reach
    # of rows at the same place, as while it is pressed, the last one; the one at a turn may belong to either side of it
    stays = numpy.r_[places[1:] == places[:-1], False]
    turns = numpy.r_[branch[1:] != branch[:-1], False]
    turns[0] = False
    could = (window >= 0) & ~stays & ~turns
    used = numpy.flatnonzero(could & (implant >= least) & (implant <= most))
    of = f"of its {len(places)} rows, {over.name} from {places.min():.4g} to {places.max():.4g},"
    if (window < 0).all():
        scene.refuse("Calibration / Windows", f"{values[ENTRY]}: none {of} is in them")
    counts = {"rows": len(places), "used": len(used), "outside_windows": int((window < 0).sum()),
              "at_rest_or_turns": int((window >= 0).sum() - could.sum()), "beyond_scene": int(could.sum() - len(used))}
    if len(used) < max(1, float(values["Expert / Calibration / Smallest share of rows"]) * could.sum()):
        why = (f"is {over.name} in the unit that the file says, and does the scene go as far as the test? Calibration / Windows leaves out "
               "what is not to be fitted, a smaller Expert / Calibration / Smallest share of rows takes these rows")
        if 2 * (could & (-implant >= least) & (-implant <= most)).sum() > could.sum():
            why = ("they have the opposite sign. Turn the load of the scene round, or the values by a minus before their unit, 'set Reference "
                   f"columns = {_with_other_sign(choice, table, columns, over)}'")
        scene.refuse(ENTRY, f"{values[ENTRY]}: only {len(used)} {of} are in what the scene comes to, {least:.4g} to {most:.4g} {over.unit}: {why}")
    return used, window[used], counts


def _check(scene, values, columns):
    if len(numbers_of(values, "Windows")) % 2:
        scene.refuse("Calibration / Windows", "expected pairs of bounds, an even number of them")
    noise = stated_noise(values)
    if len(noise) not in (1, len(columns)):
        scene.refuse("Calibration / Noise", "expected one number, or one for each of Curves")


def _proposed(scene, columns, over, least_turn):
    """Places over all of the load, of a test that has not been done."""
    times = numpy.linspace(scene.sample_times[0], scene.sample_times[-1], 401)
    places = _places(scene, over, times)
    if places is None:
        scene.refuse("Calibration / Over", "what a test that has not been done is drawn over must be prescribed by its scene")
    kept = places[numpy.r_[places[1:] != places[:-1], True]]
    return Measurement("", kept, numpy.zeros((0, len(columns))), branches_of(kept, least_turn), least_turn,
                       numpy.zeros(len(columns)), parts=[slice(0, len(kept))], share=numpy.linspace(0, 1, len(kept)), signs=[1] * (1 + len(columns)))


def _remarks(file, over, places, planned):
    """What may be wrong with measured places, in words."""
    if planned is None or over.kind == "time":
        return []
    measured, most = abs(places).max(), abs(planned).max()
    return [f"{file}: {over.name} ends at {measured:.4g} and the scene at {most:.4g} {over.unit}: is it in {over.unit}?"] * bool(
        measured < 0.05 * most)


def read(scene, values, columns, over, largest_shift=0.0, compliance=0.0):
    """The Measurement of a scene, whose entries are `values`: `columns` along `over`. The rig may show `largest_shift` more than
    the implant has moved, and as much as the load times `compliance`. Raises SceneError."""
    _check(scene, values, columns)
    planned, file = _places(scene, over, scene.sample_times), given(values[ENTRY])
    least_turn = _least_turn(planned)
    if not file:
        return _proposed(scene, columns, over, least_turn)
    table, said, choice = _read(scene, file, [column.name for column in (over, *columns)], given(values["Output / Reference columns"]))
    branch = branches_of(table[:, 0], least_turn)
    used, window, counts = _used_rows(scene, values, columns, over, table, choice, branch, _reach(planned, largest_shift), compliance)
    if planned is not None and compliance == 0:  # a soft machine may turn back by itself
        try:
            branches_like(planned, (table[used, 0], branch[used]), least_turn)
        except RunError as error:
            scene.refuse(ENTRY, str(error))
    scale = numpy.abs(table[:, 1:]).max(axis=0)  # of the whole file, so that a window changes no weight
    for column, largest in zip(columns, scale):
        if largest == 0:
            scene.refuse(ENTRY, f"{file}: all of {column.name} is zero")
    edges = [0, *(numpy.flatnonzero(numpy.diff(window)) + 1), len(used)]
    return Measurement(file, table[used, 0], table[used, 1:], branch[used], least_turn, scale,
                       _stated_noise(scene, values, columns, used, scale), [slice(a, b) for a, b in zip(edges, edges[1:])],
                       used / max(1, len(table) - 1), [-1 if measured.is_turned(item) else 1 for item in choice],
                       counts, _remarks(file, over, table[:, 0], planned), planned is not None, said)


def _read(scene, file, names, columns, columns_entry="Output / Reference columns"):
    """Columns of a measured file (rows x columns), which they are, in words and as a choice; what is wrong is said with the place
    of its entry."""
    try:
        values, said, choice = measured.read_measured_and_say(file, names, columns, columns_entry=columns_entry)
        return values.T, said, choice
    except InputError as error:
        if error.why is None:
            raise
        scene.refuse(error.entry, error.why)


def _stated_noise(scene, values, columns, used, scale):
    """Standard deviations as the scene states them (n x curves), or None."""
    choice, entry = _list_of(values["Expert / Calibration / Noise columns"]), "Expert / Calibration / Noise columns"
    if not choice:
        noise = numpy.array(stated_noise(values))
        return numpy.tile(noise * scale, (len(used), 1)) if noise[0] > 0 else None
    if len(choice) != len(columns):
        scene.refuse(entry, "expected one for each of Curves")
    sd = _read(scene, values[ENTRY], [column.name for column in columns], choice, entry)[0][used]
    for row, c in numpy.argwhere(~(sd > 0))[:1]:
        scene.refuse(entry, f"{values[ENTRY]}: the standard deviation of {columns[c].name} in row {used[row] + 1} is "
                            f"{sd[row, c]:.4g}: expected a number above 0")
    return sd
