"""Tables as laboratories write them, read by debond.measured: those in lab_files with what a person reads in them, and
texts and workbooks that are written here; and what is said of files that cannot be understood.

    PYTHONPATH=python python3 tests/python/measured.py
"""

import contextlib
import csv
import datetime
import io
import os
import sys
import tempfile

import numpy

from debond import measured
from debond.__main__ import main
from debond.errors import InputError
from debond.measured import read_measured, read_measured_and_say

HERE = os.path.dirname(os.path.abspath(__file__))
LAB_FILES = os.path.join(HERE, "lab_files")
CURVE = ("angle_deg", "torque_Nmm")
TWO_ROWS, THREE_ROWS = [[0.5, 1], [20, 50]], [[0.5, 1, 1.5], [20, 50, 45]]

# read now: (file, columns) -> rows, where expected.csv has the words of a refusal
READ_NOW = {"utf_16.csv": TWO_ROWS, "utf_16_without_mark.csv": TWO_ROWS}
# what a chuck is to do over the time
PUSH = {"chuck_units_of_force.csv": [[0, 1, 2], [0, -10, -10]], "chuck_quoted_commas.csv": [[0, 1, 2], [0, -10, -10]],
        "chuck_units_of_length.csv": [[0, 1, 2], [0, -1.016, -1.016]],
        "chuck_units_of_time.csv": [[0, 1, 1.5], [0, -1e-3, -1e-3]],
        "chuck_goes_back.csv": [[0, 1, 0.5, 2], [0, -1e-3, -2e-3, -1e-3]]}

ANGLE = "has a unit that says deg, rad, mrad, gon or rev: "
TORQUE = "has a unit that says N mm, mN m, N cm, N m, kN m, lbf in, ozf in, kgf cm or the like: "
SAY = "; say which, as in 'set Reference columns = 1 [deg], 2 [N m]'"
NO_ROW = ("this file holds no row of numbers; expected are two columns or more, separated by commas, semicolons, tabs or "
          "blanks")

# text, columns, and what is said of it: nothing if it holds TWO_ROWS
TEXTS = [
    ("step,time,angle_deg,torque_Nmm,chuck_Mx_Nmm,chuck_rx_deg\n0,0,0.5,20,1,2\n1,1,1,50,3,nan\n", "", ""),
    ("\ufeffWinkel [°];Drehmoment [Nm]\r\n0,5;0,02\r\n1,0;5e-2\r\n", "", ""),
    ("Torque meter 4711\nOperator\tA. B.\n\ntime\tangle\ttorque\ns\tdeg\tN cm\n0\t0.5\t2\n1\t1\t5\n", "", ""),
    ("  angle/rad  torque/N.mm\n 0,00872664625997164788  20\n 0,0174532925199432958   50\n", "", ""),
    ('"angle (deg)","torque, mean (mNm)"\n"0.5","20"\n1,"50"\n', "", ""),
    ("time;angle in deg;torque in N*m\n12:00:01;0,5;0,02\n12:00:02;1;0,05\n", "", ""),
    ("1\t20\t0.5\n2\t50\t1\n", "3 [deg], 2 [N mm]", ""),
    ("M1 [N m],M2 [N m],phi\n9,0.02,0.5\n9,0.05,1\n", "phi [deg], M2", ""),
    ("# first\nangle_deg,torque_Nmm\n0.5,20\n# between\n1,50\n", "", ""),
    ("ANGLE (DEG)\tTORQUE (Nmm)\n0.5\t20\n1\t50\n", "", ""),
    ("angle [deg];torque [Nm]\n0,5;-0,02\n1;-0,05\n", "angle, 2 [ -N m]", ""),
    ("angle_deg,torque_Nmm\n.5,+2d1\n1.,0.5D+02\n", "", ""),
    ("phi,deg;M,Nmm\n0.5;20\n1;50\n", "", ""),
    ("% made\n// by\nangle_deg,torque_Nmm\n0.5,20\n// between\n1,50\n", "", ""),
    # names and units in two lines; a line of names above others
    ("phi;x;M\ndeg;;N mm\n0,5;7;20\n1;7;50\n", "phi, M", ""),
    ("phi;M\n[deg];[N mm]\n0,5;20\n1;50\n", "phi, M", ""),
    ("test;seven\nphi;M\n0,5;20\n1;50\n", "phi [deg], M [N mm]", ""),
    # semicolons in a column of times
    ("phi [deg],M [Nmm],t\n5e-1,2e1,12:00:00;1;1\n1e0,5e1,12:00:01;1;1\n", "", ""),
    # German and French names
    ("Zeit [Sek.];Winkel in Grad;Drehmoment in Nmm\n1;0,5;20\n2;1;50\n", "", ""),
    ("Zeit in s;Weg in mm;Kraft in N;Drehwinkel (Grad);Moment [Ncm]\n1;2;3;0,5;2\n2;3;4;1;5\n", "", ""),
    ("Winkel;Drehmoment\nGrad;Ncm\n0,5;2\n1;5\n", "", ""),
    ("Temps (s);Angle en degrés;Couple (N·m)\n1;0,5;0,02\n2;1;0,05\n", "", ""),
    # the marks of Excel: separators are said, decimal commas are in quotes, cells are empty
    ('sep=,\n"Winkel [°]","M [Nmm]",\n"0,500","20,0",\n"1,0","50,00",\n', "", ""),
    ('"angle, mean [deg]","torque, ""raw"" [N mm]"\n"0,5","20"\n"1","5,0E+01"\n', "", ""),
    ("angle,torque\n0.5,20\n1,50\n", "", f"no column {ANGLE}the columns of this file are 'angle', 'torque'{SAY}"),
    ("angle_deg,M1 [Nm],M2 [Nm]\n0.5,1,2\n1,2,3\n", "",
     f"more than one column {TORQUE}the columns of this file are 'angle_deg', 'M1 [Nm]', 'M2 [Nm]'{SAY}"),
    ("0.5 20\n1 50\n", "", f"no column {ANGLE}this file has 2 columns without names{SAY}"),
    ("0.5 20\n1 50\n", "1 [deg]", "expected 2 columns, separated by commas"),
    ("0.5 20\n1 50\n", "1 [mm], 2 [N m]",
     "the column '1' needs a unit, deg, rad, mrad, gon or rev, in brackets behind its name"),
    ("0.5 20\n1 50\n", "1 [deg], 2 [nm]", "in brackets behind its name (nm may be N m or nanometres)"),
    *[(f"{name};M [N mm]\n0.5;20\n1;50\n", "", "grad may be degrees, deg, or gon, of which a turn has 400")
      for name in ("Angle [Grad]", "Winkel [grad]", "ANGLE IN GRAD")],
    ("phi,M\n0.5,20\n1,50\n", "phi [deg], T [N m]", "there is no column 'T': the columns of this file are 'phi', 'M'"),
    ("0.5 20\n1 50\n", "1 [deg], 3 [N m]", "there is no column '3': this file has 2 columns without names"),
    ("angle_deg,torque_Nmm\n0,5,20,1\n1,1,50,2\n", "",
     "line 1 names 2 columns, line 2 has 4 values: if decimals have commas, separate the columns with semicolons"),
    ("angle_deg,torque_Nmm\n0.5,20\nend,50\n", "",
     "line 3: 'end' in column 1 is no number: remove what is not part of the table"),
    ("angle_deg;torque_Nmm\n0,5;20\n1;1.050\n", "", "line 3 has a number with a point and line 2 one with a comma: write "
     "decimals in one way, and thousands without a separator"),
    ("angle_deg\ttorque_Nmm\n0.5\t1 020\n1\t1 050\n", "", NO_ROW + ", and its first line is 'angle_deg\ttorque_Nmm'; "
     "'1 020' in line 2: write thousands without a separator"),
    ('angle_deg,torque_Nmm\n1,"1,020"\n2,"1,050"\n', "", "the comma in numbers, as in line 2, may be that of decimals or of "
     "thousands: write decimals in one way"),
    ("angle [deg];torque [Nm] x10\n0,5;2\n1;5\n", "", f"no column {TORQUE}the columns of this file are"),
    ("angle_deg;torque_Nmm\n0.5;20\n1;\n", "", "line 3: no value in column 2"),
    ("angle_deg;torque_Nmm\n0.5;20\n1\n", "", "line 3: no value in column 2"),
    ("angle_deg;torque_Nmm\n0.5;20;7\n1;50\n", "", "line 2: 3 values for 2 columns"),
    ("angle_deg;torque_Nmm\n0.5;20\n---;---\n", "", "line 3: '---' in column 1 is no number: remove this row"),
    ("angle_deg;torque_Nmm\n0.5;20\n1;50,\n", "", "line 3: '50,' in column 2 is no number"),
    ("angle_deg;torque_Nmm\n0.5;20\n1;over-range\n", "", "line 3: 'over-range' in column 2 is no number: remove this row"),
    ("angle_deg;torque_Nmm\n0.5;20\n1;1e-310\n", "", "line 3: '1e-310' in column 2 is no number: remove this row"),
    ("angle_deg,torque_Nmm\n", "", NO_ROW + ", and its first line is 'angle_deg,torque_Nmm'"),
    ("", "", NO_ROW),
    ("angle_deg,torque_Nmm\n0.5,20\0\n", "", "this is not a text file"),
]

scratch = tempfile.TemporaryDirectory()
n_tables = 0


def path(name):
    return os.path.join(scratch.name, name)


def written(content, name="curve.csv"):
    with open(path(name), "wb") as file:
        file.write(content if isinstance(content, bytes) else content.encode())
    return path(name)


def expect_values(filename, wanted, columns, expected):
    global n_tables
    n_tables += 1
    values = read_measured(filename, wanted, columns)
    is_right = values.shape == numpy.shape(expected) and numpy.allclose(values, expected, rtol=1e-12, atol=0)
    assert is_right, f"{filename} {columns}: expected {expected}, got {values.tolist()}"


def expect_refusal(filename, wanted, columns, words):
    """One line that names the file, or the choice of columns, and has the words."""
    global n_tables
    n_tables += 1
    try:
        values = read_measured(filename, wanted, columns)
    except InputError as error:
        text = str(error)
        assert "\n" not in text and (os.path.basename(filename) in text or error.entry == measured.COLUMNS_ENTRY), text
        assert text.startswith(f"{error.entry} = '{error.value}': "), text
        text = text.replace(filename, "")
        assert all(word in text for word in words), f"{filename} {columns}: expected {words}, got {text}"
        return
    raise AssertionError(f"{filename} {columns}: expected a refusal with {words}, got {values.tolist()}")


def lines_of(name):
    with open(os.path.join(LAB_FILES, name), newline="", encoding="utf-8") as table:
        return list(csv.reader(table))[1:]


def check_lab_files():
    for name, columns, expected in lines_of("expected.csv"):
        filename = os.path.join(LAB_FILES, "files", name)
        if name in READ_NOW:
            expect_values(filename, CURVE, columns, READ_NOW[name])
        elif expected.startswith("!"):
            expect_refusal(filename, CURVE, columns, [word.strip() for word in expected[1:].split(";")])
        else:
            rows = [[float(number) for number in row.split(":")] for row in expected.split()]
            expect_values(filename, CURVE, columns, numpy.transpose(rows))
    for name, columns, control, expected in lines_of("expected_chuck.csv"):
        filename = os.path.join(LAB_FILES, "files", name)
        wanted = ("time", "chuck_Fz_N" if control == "force" else "chuck_uz_mm")
        if name in PUSH:
            expect_values(filename, wanted, columns, PUSH[name])
        else:
            expect_refusal(filename, wanted, columns, [word.strip() for word in expected[1:].split(";")])


def check_texts():
    for text, columns, words in TEXTS:
        if words:
            expect_refusal(written(text), CURVE, columns, [words])
        else:
            expect_values(written(text), CURVE, columns, TWO_ROWS)
    table = "Winkel [°];Drehmoment [µN·m]\r\n0,5;20000\r\n1;50000\r\n"
    for encoding in ("utf-8", "utf-8-sig", "latin-1", "utf-16", "utf-16-le", "utf-16-be"):
        expect_values(written(table.encode(encoding)), CURVE, "", TWO_ROWS)
    expect_values(written(b"\xfe\xff" + table.encode("utf-16-be")), CURVE, (), TWO_ROWS)
    expect_values(written("a;b\n1;0,5\n2;1\n"), ("angle_deg", "time"), ["2 [deg]", "a [min]"], [[0.5, 1], [60, 120]])
    expect_values(written(b"phi [deg];M [Nmm]\n0,5;\x9620\n1;\x9650\n"), CURVE, "1, 2 [-Nmm]", TWO_ROWS)
    # a row with an empty last column above a comment
    expect_values(written("phi [deg];M [Nmm];x\n0,5;20;\n# between\n1;50;7\n1,5;45;7\n"), CURVE, "", THREE_ROWS)
    expect_values(written("phi [deg];M [Nmm]\n1,500;20,125\n2,500;50,125\n"), CURVE, "", [[1.5, 2.5], [20.125, 50.125]])
    expect_refusal(written(b"\xff\xfea\0;"), CURVE, "", ["UTF-16"])
    expect_refusal(path("none.csv"), CURVE, "", ["this file cannot be read: No such file or directory"])
    expect_refusal(scratch.name, CURVE, "", ["Is a directory"])
    measured._LARGEST_MB, largest = 1, measured._LARGEST_MB
    expect_refusal("/dev/zero", CURVE, "", ["this file has more than 1 MB"])
    measured._LARGEST_MB = largest


def workbook(*sheets, hidden=()):
    """A file with sheets of rows; hidden: {name: state}."""
    import openpyxl

    book = openpyxl.Workbook()
    book.remove(book.active)
    for title, rows in sheets:
        sheet = book.create_sheet(title)
        sheet.sheet_state = dict(hidden).get(title, "visible")
        for row in rows:
            sheet.append(row)
    book.save(path("book.xlsx"))
    return path("book.xlsx")


def check_workbooks():
    info = ("Info", [["Sample", "A7"], ["Date", datetime.date(2024, 3, 1)]])
    times = [datetime.time(12, 0, second) for second in range(3)]
    rows = [[time, *row] for time, *row in zip(times, [0.5, 1, 1.5], [0.02, 0.05, 0.045])]
    expect_values(workbook(info, ("Data", [["Test 1"], [], ["Zeit", "Winkel\n[°]", "M [N m]"], *rows])), CURVE, "", THREE_ROWS)
    indented = [[None, "s", "deg", "N cm"], [None, 1, 0.5, 2], [None, 2, 1, 5]]
    expect_values(workbook(("A", indented), info), CURVE, "3, 4", TWO_ROWS)
    # numbers that are texts
    expect_values(workbook(("A", [['phi 5" [deg]', "M [N mm]"], ["0,5", "20"], ["1,0", "50"]])), CURVE, "", TWO_ROWS)
    digits = 1.0234567890123e-5
    expect_values(workbook(("A", [[1, 0.5, digits], [2, 1, 1]])), CURVE, "2 [deg], 3 [kN m]", [[0.5, 1], [1e6 * digits, 1e6]])
    # a formula that no program has computed
    formula = workbook(("A", [["phi [deg]", "M [Nmm]"], [0.5, 20], [1, "=2*B2"]]))
    no_value = ": this formula has no value yet: save the workbook once with a program that computes it"
    expect_refusal(formula, CURVE, "", ["line 3: '=2*B2' in column 2 is no number" + no_value])
    formulas = workbook(("A", [["phi [deg]", "M [Nmm]"], [0.5, "=40*A2"], [1, "=50*A3"]]))
    expect_refusal(formulas, CURVE, "", [NO_ROW, "; '=40*A2' in line 2" + no_value])
    # beside the columns that are read
    expect_values(workbook(("A", [["phi [deg]", "M [Nmm]", "x"], [0.5, 20, "=2*B2"], [1, 50, "=2*B3"]])), CURVE, "", TWO_ROWS)
    broken = [*rows, [datetime.time(12, 0, 3), 2, "OVERLOAD"]]
    expect_refusal(workbook(info, ("Data", [["Zeit", "Winkel [°]", "M [N m]"], *broken])), CURVE, "",
                   ["sheet 'Data': line 5: 'OVERLOAD' in column 3 is no number: remove this row"])
    expect_refusal(workbook(("Data", rows)), CURVE, "1 [deg], 2 [N m]", ["line 1: '12:00:00' in column 1", "time of day"])
    expect_refusal(workbook(info), CURVE, "", ["sheet 'Info': " + NO_ROW])
    # what is hidden is not meant
    sheets = [(name, [CURVE, *rows]) for name, rows in (("Old", [[1, 7], [2, 8]]), ("New", [[0.5, 20], [1, 50]]))]
    for state in ("hidden", "veryHidden"):
        expect_values(workbook(*sheets, hidden={"Old": state}), CURVE, "", TWO_ROWS)
    for hidden, words in (({"Old": "hidden"}, "sheet 'New', column 1"), ({}, "sheet 'Old', the first of 2 with numbers, column 1")):
        assert read_measured_and_say(workbook(*sheets, hidden=hidden), CURVE)[1].startswith(words), f"several sheets: {words}"
    assert "the first of 2" in output_of(path("book.xlsx"))[2], "the command does not name the sheet"
    expect_refusal(written(b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1" + 504 * b"\0", "book.xls"), CURVE, "", ["(.xls)", "as CSV"])
    ods = b"PK\x03\x04" + 26 * b"\0" + b"mimetypeapplication/vnd.oasis.opendocument.spreadsheet"
    expect_refusal(written(ods, "book.ods"), CURVE, "", ["save it as .xlsx or as CSV"])
    with open(workbook(info), "rb") as file:
        expect_refusal(written(file.read()[:500]), CURVE, "", ["this workbook cannot be read"])


def output_of(*arguments):
    """Exit code and output of the program that writes plain CSV."""
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        code = main(["measured", *arguments])
    return code, out.getvalue(), err.getvalue()


def check_plain():
    """Plain CSV has the names, and gives all digits back."""
    table = written("t [min];phi [rad];F [lbf];M [ozf in]\n0,1;0,3;7;0,7\n0,2;0,6;-9;0,9\n")
    for curves in ("angle_deg,torque_Nmm", "time, chuck_Fz_N"):
        code, plain, _ = output_of(table, "--curves", curves)
        names = [name.strip() for name in curves.split(",")]
        assert code == 0 and plain.splitlines()[0] == ",".join(names), plain
        again = numpy.loadtxt(plain.splitlines(), delimiter=",", skiprows=1).T
        assert numpy.array_equal(again, read_measured(table, names)), f"not the same numbers: {plain}"
    assert output_of(table, "--columns", "1 [deg], 2 [-N mm]")[1] == "angle_deg,torque_Nmm\n0.1,-0.3\n0.2,-0.6\n", "--columns"
    code, out, error = output_of(table, "--columns", "phi, 9")
    assert (code, out) == (1, "") and error.startswith("--columns = 'phi, 9': there is no column '9': "), error
    for arguments in ([], [table, table], [table, "--columns"], [table, "--curve", "time"], [table, "--curves", "slip"]):
        code, out, error = output_of(*arguments)
        assert (code, out) == (1, "") and "expected" in error, f"{arguments}: {code}, {error}"


check_lab_files()
check_texts()
check_workbooks()
check_plain()
print(f"{n_tables} tables are read, or refused, as they should be")
sys.exit(0)
