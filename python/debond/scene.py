"""Scenes, and runs of them in memory."""

import hashlib
import io
import json
import os
import pathlib
import sys
import tempfile
from typing import Any, Callable, Dict, List, Mapping, Optional, Tuple

import numpy

import _debond

from .errors import SceneError, expect, path_of
from .page import write_page_if_possible
from .page_data import number
from .variants import variants_of

__version__ = _debond.version


def _text(value: Any) -> str:
    """A value of Python as a scene writes it."""
    if isinstance(value, (bool, numpy.bool_)):
        return "true" if value else "false"
    if isinstance(value, (int, float, numpy.number)):
        return repr(value.item() if isinstance(value, numpy.generic) else value)
    if isinstance(value, (list, tuple, numpy.ndarray)):
        return ", ".join(_text(item) for item in value)
    return os.fspath(value) if isinstance(value, os.PathLike) else str(value)


def _known(summary: str) -> Dict[str, Any]:
    """The members of a summary that have a value."""
    return {name: value for name, value in json.loads(summary).items() if value is not None}


def _team(comm):
    """The processes that solve together: those of `comm`, a communicator of mpi4py; None: this one alone."""
    if comm is None:
        return _debond.Team(0)
    mpi = sys.modules.get("mpi4py.MPI")
    if mpi is None or not isinstance(comm, mpi.Intracomm):
        raise SceneError(f"comm: {type(comm).__name__}: expected a communicator of mpi4py within a group of processes to which "
                         "this one belongs, as MPI.COMM_WORLD")
    theirs, ours = mpi.Get_library_version(), _debond.mpi_library
    if theirs != ours:
        raise SceneError(f"comm: mpi4py was built with {theirs:.60}, debond with {ours:.60}: expected the same MPI library")
    return _debond.Team(mpi._addressof(comm))


def _agreed(team, work):
    """What work() makes of arguments. It has to be the same on all processes of a team, and what one raises they all raise."""
    result = mistake = None
    try:
        result = work()
    except Exception as error:
        mistake = error
    said = team.gather(f"!{mistake}" if mistake else repr(result))
    if mistake:
        raise mistake
    for rank, text in enumerate(said):
        if text[0] == "!":
            raise SceneError(text[1:])
        if text != said[0]:
            raise SceneError(f"the processes of comm ask for different things: {said[0]} on rank 0, {text} on rank {rank}")
    return result


def sample_law(law: Callable[[float], float], longest: float, tolerance: float = 1e-4) -> Tuple[numpy.ndarray, numpy.ndarray]:
    """Sliding distances [mm] and bonding states such that a line through them is within `tolerance` of `law` from 0 to
    `longest` [mm]. Raises SceneError if the law does not fall from 1, or is no number somewhere."""

    def phi(slip):
        value = number(law(slip))
        if not 0 <= value <= 1:
            raise SceneError(f"law: phi({slip:g} mm) = {value}: expected a number from 0 to 1")
        return value

    expect(callable(law), "law", law, "a function of the sliding distance [mm]")
    expect(isinstance(longest, (int, float, numpy.number)) and 0 < longest < numpy.inf, "law: distance", longest,
           "the sliding distance [mm] after which phi is constant, above 0")
    points = {slip: phi(slip) for slip in numpy.linspace(0, longest, 33)}
    if abs(points[0] - 1) > 1e-12:
        raise SceneError(f"law: phi(0) = {points[0]:g}: expected 1, the whole bond; Bonding degree makes it less")
    intervals = list(zip(sorted(points)[:-1], sorted(points)[1:]))
    while intervals and len(points) < 2000:
        a, b = intervals.pop()
        points[(a + b) / 2] = phi((a + b) / 2)
        is_curved = abs(points[(a + b) / 2] - (points[a] + points[b]) / 2) > tolerance
        if is_curved and b - a > 1e-6 * longest:  # a jump is not halved for ever
            intervals += [(a, (a + b) / 2), ((a + b) / 2, b)]
    slip = numpy.array(sorted(points))
    values = numpy.array([points[s] for s in slip])
    rises = numpy.flatnonzero(numpy.diff(values) > 0)
    if rises.size:
        raise SceneError(f"law: phi rises from {slip[rises[0]]:g} to {slip[rises[0] + 1]:g} mm: a bond only breaks")
    return slip, values


class Scene:
    """What is simulated: the file `filename`, or another Scene, or `text` in the language of scenes, or only `entries`.
    Scenes can be copied and pickled.

    entries: {"Subsection/Entry": value} in addition or instead; numbers, truth values, text, or sequences for lists.
    law: (function, distance): phi over the sliding distance [mm], falling from 1, constant beyond `distance` [mm]. It is
    sampled once, to the law `table`.

    Raises SceneError."""

    def __init__(self, filename=None, entries: Optional[Mapping[str, Any]] = None, *, text: str = "",
                 law: Optional[Tuple[Callable[[float], float], float]] = None):
        expect(not isinstance(filename, Mapping), "scene", filename, "a file, or Scene(None, {...})")
        if filename is not None and text:
            raise SceneError("a scene is either a file or a text, not both")
        expect(entries is None or isinstance(entries, Mapping), "entries", entries, 'a dictionary {"Subsection/Entry": value}')
        expect(isinstance(text, str), "text", text, "a text in the language of scenes")
        overrides = [f"{name}={_text(value)}" for name, value in (entries or {}).items()]
        base = filename if isinstance(filename, Scene) else None
        self._name = base._name if base else "scene" if filename is None else path_of(filename, "scene", "the name of a file or a Scene")
        self._tables = list(base._tables) if base else []  # files live as long as a scene that needs them
        if law is not None:
            expect(isinstance(law, (tuple, list)) and len(law) == 2 and callable(law[0]), "law", law,
                   "a pair, (function, distance [mm]): phi over the sliding distance, and the distance after which it is constant")
            overrides += ["Interface/Friction law=table", "Interface/Friction table=" + self._write_table(*law)]
        entries = (base._entries if base else _debond.read_file(self._name) if filename is not None else
                   _debond.read_text(text, "scene") if text else [])
        self._entries = _debond.changed(entries, overrides)

    def _write_table(self, law, longest) -> str:
        text = io.StringIO()
        numpy.savetxt(text, numpy.column_stack(sample_law(law, longest)), "%.17g", ",", header="slip_mm,phi", comments="")
        return self._new_table(text.getvalue())

    def _new_table(self, text) -> str:
        directory = tempfile.TemporaryDirectory(prefix="debond-")
        self._tables.append(directory)
        name = pathlib.Path(directory.name, "law.csv")
        name.write_text(text, encoding="utf-8")
        return str(name)

    def __getstate__(self):
        names = [pathlib.Path(directory.name, "law.csv") for directory in self._tables]
        return self._entries, self._name, {str(name): name.read_text(encoding="utf-8") for name in names}

    def __setstate__(self, state):
        self._entries, self._name, tables = state
        self._tables = []
        entry = "Interface / Friction table"
        for name, text in tables.items():
            if any((own.name, own.value) == (entry, name) for own in self._entries):
                self._entries = _debond.with_values(self._entries, {entry: self._new_table(text)})

    def _read(self, team, changes=()):
        for entry in self._entries:
            if "<<" in entry.value:
                entry.refuse("<<...>> stands for an unknown: debond.fit(scene) finds it, and so does debond.calibrate(scene), into a directory")
        return _debond.Scene(_debond.changed(self._entries, list(changes)), self._name, team)

    def variants(self) -> List["Scene"]:
        """Of a study, whose entries hold several values {{a|b}}: the scenes of its variants, for run_many()."""
        result = []
        for one in variants_of(self._entries):
            variant = Scene()
            variant._entries, variant._name, variant._tables = one.entries, self._name, self._tables
            result.append(variant)
        return result

    @property
    def parameters(self) -> str:
        """All entries with their values, as the text of a scene."""
        return self._read(_team(None)).parameters

    @property
    def warnings(self) -> List[str]:
        """What is allowed in it, but likely to be a mistake."""
        return self._read(_team(None)).warnings

    def __repr__(self) -> str:
        return f"Scene({self._name!r}, {len(self._entries)} entries)"

    def run(self, on_row: Optional[Callable[[Dict[str, float]], None]] = None, *, comm=None) -> "Result":
        """Runs it in memory and returns its rows. on_row is called with each row of finite elements. comm: as of Simulation.
        Raises RunError."""
        team = _team(comm)
        scene = self._read(team)
        model = scene.values["Model"]
        if model != "finite elements":
            rows, summary = _debond.closed_form(scene, team)
            return Result(rows, _known(summary), scene.warnings)
        simulation = Simulation(self, comm=comm)
        simulation.run(on_row)
        return simulation.result()

    def write(self, directory=None, force: bool = False, *, comm=None) -> str:
        """Runs it as the program does, into a directory with all files and report.html; returns the directory. force: as the
        option --force. comm: as of Simulation; the first of its processes writes."""
        team = _team(comm)
        scene = self._read(team, [] if directory is None else ["Output/Directory=" + path_of(directory, "directory")])
        _debond.run_into_directory(scene, force, team)
        if scene.values["Output / Report"] == "true" and (comm is None or comm.rank == 0):
            write_page_if_possible(scene.values["Output / Directory"])
        return scene.values["Output / Directory"]


class Result:
    """rows: {column of torque.csv: array with a value per row}; summary: the measures of the curve that summary.json has;
    warnings: texts."""

    def __init__(self, rows, summary, warnings):
        self.rows, self.summary, self.warnings = rows, summary, warnings

    def frame(self):
        """The rows as a pandas.DataFrame. Raises ImportError without pandas."""
        import pandas

        return pandas.DataFrame(self.rows)


class Simulation:
    """Finite elements, row by row, whatever Model the scene names.

    drive: {component of the chuck: value at the first time}, "Press", "Translation x" ... "Rotation z", in mm or degrees, N or N mm if
    its Control says so. advance() is told where they go; their Value in the scene does not count. Between rows they go along
    straight lines, and rows are those of Load steps, of which the scene says Steps and Adaptive = false.

        simulation = debond.Simulation(scene, drive={"Rotation z": 0, "Press": 0})
        while not simulation.is_finished:
            simulation.advance({"Rotation z": angle, "Press": force})
            angle += 0.1 if simulation.row["torque_Nmm"] < 40 else 0.02

    comm: a communicator of mpi4py whose processes solve the scene together, by multigrid; each of them makes the same calls.
    Without it this process works alone, whatever mpirun has started.

    Raises SceneError; advance() and run() raise RunError, too. After any exception the simulation is in its last row, to the
    last bit, drive included, and goes on as if what failed had not been tried."""

    def __init__(self, scene: Scene, drive: Optional[Mapping[str, float]] = None, *, comm=None):
        self._team = _team(comm)
        driven = _agreed(self._team, lambda: expect(isinstance(scene, Scene), "scene", scene, "a debond.Scene, as debond.Scene(FILE)")
                         or self._numbers(drive))
        self._scene = scene  # keeps the table of a law
        self._run = _debond.Run(scene._read(self._team), driven, self._team)

    @staticmethod
    def _numbers(values) -> Dict[str, float]:
        expect(values is None or isinstance(values, Mapping), "values of the chuck", values, 'a dictionary, as {"Rotation z": 0}')
        values = dict(sorted((values or {}).items()))
        for name, value in values.items():
            values[name] = number(value)
            expect(numpy.isfinite(values[name]), name, value, "a finite number")
        return values

    @property
    def is_finished(self) -> bool:
        return self._run.is_finished

    def advance(self, values: Optional[Mapping[str, float]] = None) -> None:
        """Computes one more row, or nothing if it raises; the first is the state at the first time. values: of driven
        components at the row's end; those that are not named stay."""
        self._run.advance(_agreed(self._team, lambda: ("advance", self._numbers(values)))[1])

    def run(self, on_row: Optional[Callable[[Dict[str, float]], None]] = None) -> None:
        """Computes all rows that are left. on_row is called with each when it is complete; what it raises ends the run, and
        the row stays. So does the row after which Ctrl-C ends it. run() or advance() go on from there."""

        _agreed(self._team, lambda: expect(on_row is None or callable(on_row), "on_row", on_row, "a function of a row") or "run")
        self._run.run(None if on_row is None else lambda: on_row(self.row))

    @property
    def row(self) -> Dict[str, float]:
        """The newest row, by the columns of torque.csv."""
        return self._run.last_row()

    def points(self) -> Dict[str, numpy.ndarray]:
        """The contact face in the newest row, a value per quadrature point that faces the implant: x_mm, y_mm, r_mm
        (reference position), pressure_MPa, traction_MPa (tangential), slip_mm (accumulated), phi, mu, state (0 open, 1 stick,
        2 slip, 3 pulled, 4 slides in the bone), area_mm2, left_by_opening and left_by_slip (parts of a full bond), mode_deg."""
        return self._run.points()

    def bulk(self, body: str, points) -> Dict[str, numpy.ndarray]:
        """What `body`, "bone" or "implant", shows in the newest row at `points` (n x 3) of its reference configuration [mm]:
        displacement_mm (n x 3) and stress_MPa (n x 3 x 3, Cauchy, in space), as in bulk.pvd. Not a number where the mesh is
        not: trilinear cells of a round implant have plane sides above the contact face; nor is the stress of a rigid body."""

        def check():
            places = numpy.asarray(points, dtype=float)
            expect(body in ("bone", "implant"), "body", body, "'bone' or 'implant'")
            expect(places.ndim == 2 and places.shape[1] == 3, "points of shape", places.shape, "n x 3")
            return body, places.tolist()

        body, places = _agreed(self._team, check)
        displacement, stress = self._run.bulk(body == "implant", numpy.reshape(places, (-1, 3)).T)
        return {"displacement_mm": displacement.T, "stress_MPa": stress.T.reshape(-1, 3, 3)}

    def save(self) -> bytes:
        """The state in its newest row, drive included: see restore()."""
        state = self._run.save()
        return hashlib.sha256(state).digest() + state

    def restore(self, state: bytes) -> None:
        """Goes to a state that save() of this simulation, or of another one of the same scene, gave; to the last bit. Raises
        SceneError for any other."""
        length = hashlib.sha256().digest_size
        if not isinstance(state, bytes) or hashlib.sha256(state[length:]).digest() != state[:length]:
            raise SceneError("this is no state that save() gave, or it was damaged since")
        self._run.restore(state[length:])

    def result(self) -> Result:
        """All rows so far."""
        run = self._run
        return Result(run.rows(), _known(run.summary()), run.warnings)


def set_number_of_threads(n: int) -> None:
    """Of one run; results do not depend on it. At first it is 1. Raises SceneError."""
    expect(isinstance(n, int) and n >= 1, "threads", n, "a whole number, 1 or more")
    _debond.set_number_of_threads(n)
