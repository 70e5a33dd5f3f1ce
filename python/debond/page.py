"""Pages of results: `python3 -m debond page DIR` writes DIR/report.html from the files in DIR.

A page needs no other file and no network. It is written whole or not at all. Needs Jinja2 and nothing else.
"""

import os
import sys

from debond import page_data
from debond.files import csv_text, make_directory, say, write_json, write_whole
from debond.page_campaigns import context_of_bench, context_of_calibration, context_of_study
from debond.page_records import context_of_records
from debond.page_run import context_of_run
from debond.page_specimens import context_of_groups, context_of_specimens, difference_in_words

#: What a directory of each kind holds, its template and what fills that.
KINDS = (("bench.json", "bench.html", context_of_bench), ("study.csv", "study.html", context_of_study), ("calibration.json", "calibration.html", context_of_calibration),
         ("specimens.json", "specimens.html", context_of_specimens), ("records.json", "records.html", context_of_records),
         ("groups.json", "groups.html", context_of_groups),
         ("summary.json", "run.html", context_of_run), ("torque.csv", "run.html", context_of_run),
         ("reactions.csv", "run.html", context_of_run))


def page_of(directory):
    """The text of the page of a directory of results. Raises NoResults if it has none, ImportError without Jinja2."""
    import jinja2
    import markupsafe

    for file, template, context in KINDS:
        if os.path.exists(os.path.join(directory, file)):
            templates = jinja2.FileSystemLoader(os.path.join(os.path.dirname(__file__), "templates"))
            environment = jinja2.Environment(loader=templates, autoescape=True, trim_blocks=True, lstrip_blocks=True,
                                             undefined=jinja2.StrictUndefined)
            environment.globals.update(vars(page_data), difference_in_words=difference_in_words)
            environment.filters["symbols"] = lambda text: markupsafe.Markup(page_data.symbols(str(markupsafe.escape(text))))
            return environment.get_template(template).render(context(directory))
    raise page_data.NoResults(f"there are no results in '{directory}', none of {', '.join(kind[0] for kind in KINDS)}")


def write_page(directory):
    """Writes report.html into a directory of results. Raises NoResults, or RunError if it cannot be written, or ImportError."""
    write_whole(os.path.join(directory, "report.html"), page_of(directory))


def write_page_if_possible(directory):
    """The same at the end of a run, which does not fail because Jinja2 is missing. Returns whether there is a page."""
    try:
        write_page(directory)
    except ImportError as error:
        say(f"There is no page of the results: it needs the module {error.name} of Python: apt install python3-{error.name}", sys.stderr)
        return False
    return True


def write_results(directory, name, about, tables):
    """A directory with NAME.json, tables {name: (columns, rows)} as CSV, and their page. Raises RunError."""
    import _debond

    make_directory(directory)
    for file, table in tables.items():
        write_whole(os.path.join(directory, file + ".csv"), csv_text(*table))
    write_json(os.path.join(directory, name + ".json"), {**about, "version": _debond.version, "provenance": _debond.provenance()})
    write_page_if_possible(directory)


def main(directory, options):
    """The command."""
    write_page(directory)
