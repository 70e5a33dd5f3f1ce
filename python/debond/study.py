"""Studies: every variant of a scene whose entries hold several values is run, and all are gathered in study.csv.

Variants run as processes of their own, so that one that fails, or for which the memory does not suffice, leaves the others
alone. Those whose bodies are the same follow each other and inherit these, condensed, from the process that starts them; results
are the same to the last digit. A variant whose directory holds finished results of the same scene is not run again, one that has
left a checkpoint goes on from it. doc/reference/results.md describes the files.
"""

import itertools
import json
import math
import multiprocessing
import os
import pathlib
import shutil
import signal
import statistics
import time
from multiprocessing.connection import Pipe, wait

import _debond

from .ensemble import write_ensemble
from .errors import Interrupted, RunError, SceneError
from .files import csv_text, heeding, say, write_whole
from .page import write_page_if_possible
from .page_campaigns import names_of
from .page_data import CHANCE, number, rows_file, with_error
from .variants import is_varied, variants_of


#: What only the study uses must not make another scene of a variant.
OF_THE_STUDY = ("Study/Reference variant=none", "Expert/Study/Factors varied at once=all", "Expert/Study/Repetitions=1", "Expert/Output/Console=quiet",
                "Output/Report=false")
ALONE = _debond.Team(0)


def _scene(entries, file, variant):
    """A mistake without a place is one of what this variant reads, and others may not."""
    try:
        return _debond.Scene(entries, file, ALONE)
    except SceneError as error:
        if error.place is None:
            error.args = (f"{variant}: {error}",)
        raise


class Variant:
    """A variant, and what its directory holds. summary: that of its last run, but seconds are medians over all repetitions; done:
    whether all runs are there; failure: why it failed."""

    def __init__(self, number, name, variant, study):
        self.number, self.values = number, variant.values
        self.name = f"variant-{number:03d}: {name}"
        self.directory = f"{study.directory}/variant-{number:03d}"
        self.n_repetitions = study.n_repetitions
        entries = _debond.changed(variant.entries, [*OF_THE_STUDY, "Output/Directory=" + self.directory], "--set")
        self.scene = _scene(entries, study.name, self.name)
        self.summary, self.repetitions, self.failure, self.done, self.is_compared = {}, [], "", False, False
        self.has_other_references, self.other_program = False, ""

    def _repetition(self, i):
        return f"{self.directory}/repetition-{i}.json"

    def look_up(self):
        """Reads what its directory holds. Returns the text of parameters.prm there, None without one."""
        existing = _debond.parameters_in(self.directory)
        if existing is not None and _debond.is_same_scene(self.scene.parameters, existing):
            self.summary = json.loads(_debond.json_in(self.directory + "/summary.json"))
        origin = self.summary.get("provenance")
        program = origin.get("program", "") if isinstance(origin, dict) else ""
        self.done = self.summary.get("converged") is True and os.path.exists(rows_file(self.directory))
        self.other_program = program if self.done and program != _debond.program else ""
        self.done = self.done and not self.other_program
        self.has_other_references = self.done and _debond.has_other_references(self.scene)
        if self.n_repetitions > 1:
            self._look_up_repetitions()
        return existing

    def _look_up_repetitions(self):
        kept = (json.loads(_debond.json_in(self._repetition(i))) for i in range(1, self.n_repetitions + 1))
        self.repetitions = list(itertools.takewhile(bool, kept))
        for name in self.summary if self.repetitions else ():
            if name == "wall_seconds" or name.startswith("seconds_"):
                seconds = [one[name] for one in self.repetitions if one.get(name) is not None]
                self.summary[name] = statistics.median(seconds) if seconds else None
        self.done = self.done and len(self.repetitions) == self.n_repetitions

    def forget_repetitions(self):
        for file in pathlib.Path(self.directory).glob("repetition-*.json"):
            file.unlink()
        self.repetitions = []

    def end_run(self, failure):
        """Takes what a run has left. Returns whether all is well, but another run is wanted."""
        self.failure = failure
        if self.n_repetitions > 1 and not failure:  # the next run writes a new summary in the place of this one
            shutil.copyfile(self.directory + "/summary.json", self._repetition(len(self.repetitions) + 1))
        self.look_up()
        self.done = self.done and not failure
        return not failure and self.summary.get("converged") is True and len(self.repetitions) < self.n_repetitions > 1

    def compare_with(self, other):
        """Puts its distance from the results of `other` into its summary; not a number as long as either is not done."""
        if not self.is_compared:
            self.is_compared = self.done and other.done
            own = self.directory if self.is_compared else ""
            distances = json.loads(_debond.distances(self.scene, own, other.directory))
            self.summary.update((name, value) for name, value in distances.items() if name in self.summary)

    def outcome(self):
        if self.done:
            torque, error, seconds = (number(self.summary.get(name)) for name in ("T_max_Nmm", "T_max_Nmm_error", "wall_seconds"))
            text = with_error(torque, error, "N mm").replace("±", "+-") if error > 0 else f"{torque:.4g} N mm"
            return f"T_max {text}, {seconds:.4g} s"
        return self.failure if self.failure.startswith("interrupted") else "failed: " + self.failure


def _run_alone(scene, bodies, n_threads, force, pipe):
    """What the process of a variant does: it says on a pipe why it failed, nothing if it did not."""
    _debond.leave_interruptions_to_parent()
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
    try:
        _debond.set_number_of_threads(n_threads)
        _debond.run_variant(scene, bodies, force)
    except MemoryError:
        pipe.send(_debond.out_of_memory)
    except Exception as error:
        pipe.send(str(error))


class Running:
    """The process of a variant, which does not outlive this one. It has been started by fork(), so that it inherits bodies."""

    def __init__(self, variant, bodies, n_threads, force):
        self.variant = variant
        self.words, pipe = Pipe(duplex=False)
        task = variant.scene, bodies, n_threads, force, pipe
        self.process = multiprocessing.get_context("fork").Process(target=_run_alone, args=task, daemon=True)
        self.process.start()
        pipe.close()

    def end(self):
        """Why it failed, empty if it did not."""
        try:
            failure = self.words.recv()
        except EOFError:
            failure = ""
        self.process.join()
        self.words.close()
        code = self.process.exitcode
        return "the process was ended by the system: " + signal.strsignal(-code) if code < 0 else failure


class Queue:
    """Variants that wait, those with the same bodies one after the other; the last bodies that were built. With fewer of them than
    run at a time they share none, because they would wait for each other."""

    def __init__(self, variants, n_jobs):
        self.n_jobs, self.groups, self.bodies = n_jobs, {}, None
        for variant in variants:  # seconds of set-up are of interest where runs are repeated
            key = _debond.what_bodies_depend_on(variant.scene) if variant.n_repetitions == 1 else ""
            self.groups.setdefault(key, []).append(variant)
        self.is_begun = False

    def next(self):
        """A variant and its bodies, None where it shares none or where these cannot be built: it will say why."""
        key, group = next(iter(self.groups.items()))
        if not self.is_begun:
            self.bodies = None  # before there are others
            if key and len(group) >= max(2, self.n_jobs):
                self.bodies = _debond.condensed_bodies(group[0].scene)
        variant, bodies = group.pop(0), self.bodies
        self.is_begun = bool(group)
        if not group:
            del self.groups[key]
            self.bodies = None
        return variant, bodies


class Study:
    """All variants of a scene, and the files of the study."""

    def __init__(self, entries, name):
        for entry in filter(is_varied, entries):
            if entry.name == "Output / Directory":
                entry.refuse("a study gives each variant a directory of its own below this one: expected one value")
        self.name = name
        variants = variants_of(entries)
        first = _scene(variants[0].entries, name, "variant-001")
        values = first.values
        self.directory, self.reports = values["Output / Directory"], values["Output / Report"] == "true"
        self.say = heeding(values["Expert / Output / Console"], say)
        self.n_repetitions = int(values["Expert / Study / Repetitions"])
        at_once, reference = values["Expert / Study / Factors varied at once"], values["Study / Reference variant"]
        if at_once != "all":
            variants = variants_of(entries, int(at_once))
        self.reference = 0 if reference == "none" else int(reference)
        if self.reference > len(variants):
            first.refuse("Study / Reference variant", f"this study has {len(variants)} variants")
        self.varied = list(variants[0].values)
        names, _ = names_of(self.varied, [list(variant.values.values()) for variant in variants], str, "; ")
        self.variants = [Variant(i, text, variant, self) for i, (text, variant) in enumerate(zip(names, variants), 1)]

    def n_done(self):
        return sum(variant.done for variant in self.variants)

    def check(self):
        """Says what would be run."""
        say(f"{len(self.variants)} variants")
        said = set()
        for variant in self.variants:
            variant.look_up()
            say(variant.name + (" (done already, but the content of its reference has changed: distances will be computed anew)"
                                if variant.has_other_references else " (done already)" * variant.done))
            doubts = _debond.check_variant(variant.scene)
            for doubt in doubts:
                if doubt not in said:
                    say("warning: " + doubt)
            said.update(doubts)

    def prepare(self, force):
        """Refuses before anything runs, and finds what is there already."""
        try:
            os.makedirs(self.directory, exist_ok=True)
        except OSError as error:
            raise SceneError.of_entry("Output / Directory", f"this directory cannot be created: {error.strerror}", self.directory) from None
        lock = _debond.DirectoryLock(self.directory)
        n_compared_anew = 0
        for variant in self.variants:
            existing, place = variant.look_up(), variant.directory
            is_this = existing is not None and _debond.is_same_scene(variant.scene.parameters, existing)
            why = (f"{place} holds results of another scene (compare its parameters.prm): choose another directory, or overwrite them "
                   "with --force" if existing is not None and not is_this else
                   f"{place} holds results of {variant.other_program}, and this is {_debond.program}: choose another directory, or "
                   "compute them again with --force" if variant.other_program else "")
            if why and not force:
                raise SceneError.of_entry("Output / Directory", why, self.directory)
            variant.done = variant.done and not force
            if variant.done and variant.has_other_references:
                _debond.compare_anew(variant.scene)
                variant.look_up()
                n_compared_anew += 1
            if os.path.isdir(place) and (force or not is_this):  # left over from another scene, or not wanted any more
                variant.forget_repetitions()
        return lock, n_compared_anew

    def run(self, n_jobs, n_threads, force):
        lock, n_compared_anew = self.prepare(force)
        done, n = self.n_done(), len(self.variants)
        self.say(f"{n} variants in {self.directory}" + f", {done} of them done already" * (done > 0))
        if n_compared_anew:
            self.say(f"The content of a reference has changed: the distances of {n_compared_anew} variant{'s' * (n_compared_anew > 1)} that "
                "had been done are computed anew")
        self._run_variants(n_jobs, n_threads, force)
        self.write_table()
        self.write_ensemble()
        self.name_best()
        has_page = self.reports and write_page_if_possible(self.directory)
        self.say(f"Results are in {self.directory}/study.csv" + " and report.html" * has_page)
        failed = n - self.n_done()
        if failed:
            raise RunError(f"{failed} of {n} variants failed: {self.directory}/study.csv says why")
        del lock

    def _run_variants(self, n_jobs, n_threads, force):
        queue = Queue([variant for variant in self.variants if not variant.done], n_jobs)
        running, n_ended, n, last_table, between = [], self.n_done(), len(self.variants), time.monotonic(), 2
        progress = _debond.Progress(os.isatty(1))
        progress.show("starting", n_ended / n)
        while queue.groups or running:
            while queue.groups and len(running) < n_jobs:
                running.append(Running(*queue.next(), n_threads, force))
            ended = wait([_debond.interruption_descriptor(), *(one.words for one in running)])
            if _debond.interrupting_signal():
                progress.hide()
                self._stop(running)
            for one in [one for one in running if one.words in ended]:
                running.remove(one)
                variant = one.variant
                if variant.end_run(one.end()):
                    running.append(Running(variant, None, n_threads, force))
                    continue
                n_ended += 1
                progress.hide()
                self.say(f"{n_ended}/{n} {variant.name}: {variant.outcome()}")
                progress.show(f"{len(running)} at work", n_ended / n)
            if time.monotonic() - last_table > between:  # the table of a large study takes a while
                begin = time.monotonic()
                self.write_table()
                last_table = time.monotonic()
                between = max(2, 50 * (last_table - begin))
        progress.hide()

    def _stop(self, running):
        """After a signal that has ended the study."""
        for one in running:
            one.process.terminate()
            one.process.join()
        self.write_table()
        if self.reports:
            write_page_if_possible(self.directory)
        number_of_signal = _debond.interrupting_signal()
        raise Interrupted(number_of_signal, f"interrupted by {signal.Signals(number_of_signal).name}: {self.n_done()} of "
                                            f"{len(self.variants)} variants are done; the same study without --force goes on with the "
                                            "others")

    def write_table(self):
        """study.csv: finished variants first say which columns there are, and in which order."""
        columns, rows = {}, {}
        for variant in sorted(self.variants, key=lambda one: not one.done):
            if self.reference:
                variant.compare_with(self.variants[self.reference - 1])
            failed = {} if variant.done else {"converged": False, "reason": variant.failure or "not run yet"}
            found = {name: value for name, value in {**variant.summary, **failed}.items()
                     if not isinstance(value, dict) and name != "changed_entries"}
            rows[variant.number] = {"variant": variant.number, **variant.values, **found}
            columns.update(rows[variant.number])
        fields = ([field_of(rows[number].get(name)) for name in columns] for number in sorted(rows))
        write_whole(f"{self.directory}/study.csv", csv_text(columns, fields, 12))

    def name_best(self):
        """The variant closest to the measured curve."""
        compared = {variant.name: number(variant.summary.get("difference_mean")) for variant in self.variants if variant.done}
        best = min(filter(lambda name: math.isfinite(compared[name]), compared), key=compared.get, default=None)
        if best is not None and not self.reference and len(self.variants) > 1:
            self.say(f"Closest to the measured curve: {best}, by {100 * compared[best]:.2g} % in the mean")

    def write_ensemble(self):
        """The seed is what stands for chance."""
        if CHANCE in self.varied:
            for note in write_ensemble(self.directory):
                self.say(note)
            self.say(f"Statistics over all seeds are in {self.directory}/ensemble.csv and ensemble_summary.csv")
            return
        for name in ("ensemble.csv", "ensemble_summary.csv"):  # of a study that was here before
            pathlib.Path(self.directory, name).unlink(missing_ok=True)


def field_of(value):
    """A member of a summary as a field of a table: lists joined, None as nan."""
    if isinstance(value, list):
        return "; ".join(f"{item:.12g}" if isinstance(item, float) else str(field_of(item)) for item in value)
    return math.nan if value is None else value


def main(scene, options):
    """The command."""
    study = Study(_debond.changed(_debond.read_file(scene), options["--set"], "--set"), scene)
    if options["--check"]:
        return study.check()
    n_jobs, processors = options["--jobs"], os.cpu_count()
    _debond.note_command(["debond", scene, *("--set=" + text for text in options["--set"])])
    for one in signal.valid_signals():
        if signal.getsignal(one) is signal.SIG_IGN:  # as SIGHUP below nohup; libraries may have caught it since
            signal.signal(one, signal.SIG_IGN)
    signal.signal(signal.SIGCHLD, signal.SIG_DFL)  # ignored, it leaves nothing to wait for
    _debond.catch_interruptions()
    return study.run(n_jobs, options["--threads"] or max(1, processors // n_jobs), options["--force"])
