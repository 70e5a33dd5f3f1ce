"""Work for executors of concurrent.futures, whichever they are: threads or processes here, mpi4py.futures, Dask."""

import multiprocessing
import os
import signal
from concurrent.futures import BrokenExecutor, ProcessPoolExecutor, as_completed
from typing import Iterable, List, Mapping, Union

import _debond

from .errors import InputError, expect
from .files import run_in
from .scene import Result, Scene

DIED = "the process that worked on it died"


def _collect(executor, function, tasks, results, say):
    """Puts results of tasks {name: task} in `results`; without those whose process died."""
    futures = {}
    try:
        for name, task in tasks.items():
            futures[executor.submit(run_in, os.getcwd(), function, task)] = name
    except BrokenExecutor:
        pass
    for future in as_completed(futures):
        name = futures[future]
        try:
            results[name] = future.result()
        except BrokenExecutor:
            continue
        except Exception as error:  # of the executor, or of what the function did not expect
            results[name] = error
        say(name, results[name])


def _with_own_processes(function, tasks, n, results, say):
    # a process that has computed with threads cannot be copied safely: new ones are begun; Ctrl-C ends them without a word
    processes = ProcessPoolExecutor(n, multiprocessing.get_context("spawn"), signal.signal, (signal.SIGINT, signal.SIG_DFL))
    try:
        _collect(processes, function, tasks, results, say)
    finally:
        processes.shutdown(cancel_futures=True)


def results_of(function, tasks, executor=None, n_jobs=1, say=lambda name, result: None):
    """{name: function(task)} of tasks {name: task}, or the exception of the one that failed; the others go on. The function is
    one of a module, and tasks can be pickled. n_jobs: processes here, if there is no executor; with 1 the work is done in this
    one. say: is called whenever one is done."""
    results = {}
    if executor is not None:
        _collect(executor, function, tasks, results, say)
    elif n_jobs == 1:
        for name, task in tasks.items():
            try:
                results[name] = function(task)
            except Exception as error:
                results[name] = error
            say(name, results[name])
    else:
        _with_own_processes(function, tasks, n_jobs, results, say)
        for name, task in tasks.items():  # a process died, with which of them is not known: each gets its own
            if name not in results:
                _with_own_processes(function, {name: task}, 1, results, say)
    return {name: results.get(name, RuntimeError(DIED)) for name in tasks}


def check_workers(executor, n, what, say=print):
    """Raises SceneError if `executor` is none of concurrent.futures, `n` processes or threads, called `what`, are no number, or
    `say` is no function."""
    expect(executor is None or hasattr(executor, "submit"), "executor", executor, "one of concurrent.futures, or none")
    expect(callable(say), "say", say, "a function of a text")
    expect(isinstance(n, int) and n >= 1, what, n, "a whole number, 1 or more")


def _run_text(text):
    return Scene(None, text=text).run()


def run_many(scenes, executor=None, *, base=None, jobs: int = 1) -> List[Union[Result, Exception]]:
    """Runs many scenes: of each its Result, or the SceneError or RunError that it failed with, in their order.

    scenes: Scene objects, or entries {"Subsection/Entry": value} that change `base`, a Scene or the name of one; without
    it the defaults. executor: of concurrent.futures; jobs: processes, if there is none."""
    expect(isinstance(scenes, Iterable) and not isinstance(scenes, (str, bytes, Mapping)), "scenes", scenes,
           "a list of Scenes or of dictionaries of entries")
    check_workers(executor, jobs, "jobs")
    scenes = list(scenes)  # they keep tables of laws
    results, tasks = {}, {}
    for i, one in enumerate(scenes):
        try:
            scene = one if isinstance(one, Scene) else Scene(base, one)
            scenes[i], tasks[i] = scene, _debond.text_of(scene._entries)
        except InputError as error:
            results[i] = error
    results.update(results_of(_run_text, tasks, executor, jobs))
    return [results[i] for i in range(len(scenes))]
