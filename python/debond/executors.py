"""Work for executors of concurrent.futures, whichever they are: threads or processes here, mpi4py.futures, Dask."""

import multiprocessing
from concurrent.futures import BrokenExecutor, ProcessPoolExecutor, as_completed

DIED = "the process that worked on it died"


def _collect(executor, function, tasks, results, say):
    """Puts results of tasks {name: task} in `results`; without those whose process died."""
    futures = {}
    try:
        for name, task in tasks.items():
            futures[executor.submit(function, task)] = name
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
    # a process that has computed with threads cannot be copied safely: new ones are begun
    processes = ProcessPoolExecutor(n, mp_context=multiprocessing.get_context("spawn"))
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
