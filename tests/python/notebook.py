"""Executes a notebook and checks the numbers that its last cell prints. Usage: notebook.py ROOT NOTEBOOK [--store],
where `import debond` finds the module. The working directory of the notebook is ROOT, its kernel is the Python that
runs this file. --store writes the notebook back with its outputs; without it those that are there must still say the same."""

import json
import os
import re
import sys
import tempfile
from pathlib import Path

# A kernel of this very Python, before Jupyter looks for others
specifications = tempfile.TemporaryDirectory(prefix="debond-kernel-")
kernel = Path(specifications.name, "kernels", "debond-test")
kernel.mkdir(parents=True)
(kernel / "kernel.json").write_text(json.dumps({
    "argv": [sys.executable, "-Xfrozen_modules=off", "-m", "ipykernel_launcher", "-f", "{connection_file}"],
    "display_name": "test", "language": "python"}))
os.environ["JUPYTER_PATH"] = specifications.name
# nothing of the user's own, and nothing left in the home directory
for name in ("IPYTHONDIR", "JUPYTER_CONFIG_DIR", "JUPYTER_RUNTIME_DIR", "MPLCONFIGDIR", "TMPDIR"):
    directory = Path(specifications.name, name.lower())
    directory.mkdir()
    os.environ[name] = str(directory)

import nbclient  # noqa: E402
import nbformat  # noqa: E402

failures = 0


def check(what, is_so, *numbers):
    global failures
    failures += not is_so
    print(f"{what}: {'yes' if is_so else 'NO'}", *numbers, flush=True)


def printed(notebook):
    """What all cells but the last print: words, and numbers."""
    code = [cell for cell in notebook.cells if cell.cell_type == "code"]
    text = "".join(output.text for cell in code[:-1] for output in cell.outputs if output.get("name") == "stdout")
    number = re.compile(r"-?\d+\.?\d*(?:e[-+]?\d+)?")
    return number.sub("#", text).split(), [float(each) for each in number.findall(text)]


def check_numbers(numbers):
    # 53.80: tests/comparison/numpy, with two layers of cells
    check("T_max of the first curve", abs(numbers["T_max_Nmm"] / 53.80 - 1) < 1e-2, numbers["T_max_Nmm"])
    check("half of the face is bonded at first", abs(numbers["phi_pressed"] - 0.5) < 1e-6, numbers["phi_pressed"])
    check("and less at 2 degrees", 0 < numbers["phi_turned"] < numbers["phi_pressed"], numbers["phi_turned"])
    few, many = numbers["peaks"]
    check("each implant with more bond is stronger", max(few) < min(many), max(few), min(many))
    check("patches matter", len(set(few)) == len(few) and max(few) - min(few) > 1e-3 * max(few), max(few) - min(few))

    print("Calibration")
    tolerances = {"eps_t": 0.06, "mu_b": 0.01, "mu_ub": 0.01, "a_s": 0.05, "b_s": 0.08, "angle_offset": 0.05}
    check("all unknowns are there", set(numbers["fitted"]) == set(tolerances))
    for name, row in numbers["fitted"].items():
        error = row["value"] / row["true"] - 1
        check(f"  {name} near the truth", abs(error) < tolerances[name], row["value"], row["true"])

    print("Posterior")
    columns = ("labels", "truth", "median", "low", "high", "interval")
    for label, truth, median, low, high, interval in zip(*(numbers[column] for column in columns)):
        ratio = (high - low) / (interval[1] - interval[0])
        check(f"  {label}: the truth is within", low < truth < high, low, truth, high)
        check(f"  {label}: the median is within the calibration's interval", interval[0] < median < interval[1], median)
        check(f"  {label}: as wide as that, by a factor of 1.5", 1 / 1.5 < ratio < 1.5, ratio)
    check("three parameters", len(numbers["labels"]) == 3)

    print("Steps and law of the notebook")
    check("the force is the one asked for", numbers["force_error"] < 1e-3, numbers["force_error"])
    constant, relaxing = numbers["torque_over_force"]
    check("torque over force is the same at the end", abs(relaxing / constant - 1) < 0.02, constant, relaxing)
    of_eq_13, exponential = numbers["D_adh_Nmm"]
    # of the whole face: (mu_ub - mu_b) (1 + b_s) a_s times the force, less what is left in the middle, 5.5 % of the exponential bond
    whole = (0.586 - 0.4) * 1.74 * 0.042 * numbers["force_N"]
    check("the laws take the energy of the bond", 0.93 * whole < exponential < of_eq_13 < whole, of_eq_13, exponential, whole)
    check("the exponential one has a lower peak", numbers["T_max_exponential"] < 0.98 * numbers["T_max_Nmm"],
          numbers["T_max_exponential"])


def main():
    root, name = sys.argv[1:3]
    notebook = nbformat.read(name, as_version=4)
    stored_words, stored_numbers = printed(notebook)
    client = nbclient.NotebookClient(notebook, timeout=600, startup_timeout=300, kernel_name="debond-test",
                                     record_timing=False, resources={"metadata": {"path": root}})
    try:
        client.execute()
    except nbclient.exceptions.CellExecutionError as error:
        check("all cells run", False)
        print(error)
        sys.exit(1)
    check("all cells run", True)
    code = [cell for cell in notebook.cells if cell.cell_type == "code"]
    text = "".join(output.text for output in code[-1].outputs if output.get("name") == "stdout")
    check("nothing on stderr", not any(output.get("name") == "stderr" for cell in code for output in cell.outputs),
          *[output.text for cell in code for output in cell.outputs if output.get("name") == "stderr"])
    pictures = sum("image/png" in output.get("data", {}) for cell in code for output in cell.outputs)
    check("a picture of each part", pictures == 7, pictures)
    check_numbers(json.loads(text))
    words, values = printed(notebook)
    if "--store" not in sys.argv[3:]:
        check("the stored output is today's; else --store", words == stored_words and all(
            abs(value - stored) <= 0.05 * abs(stored) for value, stored in zip(values, stored_numbers)), values, stored_numbers)
    else:
        notebook.metadata = {"kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"},
                             "language_info": {"name": "python"}}
        nbformat.write(notebook, name)
    sys.exit(failures > 0)


main()
