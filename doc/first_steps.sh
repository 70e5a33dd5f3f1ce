#!/usr/bin/env bash
# The first hour with debond on Debian 12 or 13, as commands to read and to type: install, run, look, a scene of one's own,
# compare with a measured curve, fit, and the same from Python. Half a minute of computing. It stops at the first result
# that is not right.
#   doc/first_steps.sh [--unpack] [PACKAGES [DIRECTORY]]
# PACKAGES   directory with debond_*.deb and python3-debond_*.deb. root installs them; others, and root with --unpack,
#            unpack them into DIRECTORY/root and use them there. Empty or left out: program and module of build/release;
#            if this file is that of an installed package, the installed ones.
# DIRECTORY  everything is written there; new or empty. Left out: a temporary one.
# Variables: BUILD, another build tree than build/release; PYTHON, another Python than /usr/bin/python3, to which the
# module of the packages belongs.
set -euo pipefail
source=$(cd -P "$(dirname "${BASH_SOURCE[0]}")/.." && pwd) # not where a link to doc lies
unpack=false
if [[ ${1:-} == --unpack ]]; then unpack=true && shift; fi
usage() { sed -n '2,/^set/{s/^# //p}' "${BASH_SOURCE[0]}"; }
if [[ ${1:-} == --help ]]; then usage && exit; fi
if (($# > 2)) || [[ ${1:-} == -* ]]; then usage >&2 && exit 1; fi
packages=${1:+$(cd "$1" && pwd)}
build=$(realpath -m "${BUILD:-$source/build/release}")
directory=${2:-$(mktemp -d -t debond-first-steps-XXXXXX)}
mkdir -p "$directory" && cd "$directory"
if [[ -n $(ls -A) ]]; then
  echo "first_steps.sh: $PWD is not empty" >&2
  exit 1
fi

# What the script needs to judge the results; nothing to type.
say() { printf '\n== %s\n' "$*"; }
fail() { echo "first_steps.sh: $*" >&2 && exit 1; }
files() { # files NAME...: they are there and not empty
  local file
  for file; do [[ -s $file ]] || fail "$PWD/$file is missing or empty"; done
  echo "ok: $*"
}
near() { # near WHAT VALUE EXPECTED PERCENT
  awk -v value="$2" -v expected="$3" -v percent="$4" 'BEGIN {
    is_number = value ~ /^[-+]?[0-9.]+(e[-+]?[0-9]+)?$/
    exit !(is_number && (value - expected)^2 <= (expected * percent / 100)^2) }' ||
    fail "$1 is '$2', expected $3 within $4 %"
  echo "ok: $1 is within $4 % of $3"
}
has() { # has FILE TEXT
  grep -qF -- "$2" "$1" || fail "$PWD/$1 does not say '$2'"
  echo "ok: $1 says '$2'"
}
number() { sed -n "s/^ *\"$2\": \([^,]*\),\{0,1\}\$/\1/p" "$1"; } # number FILE NAME, from summary.json
python3() { "${PYTHON:-/usr/bin/python3}" -B "$@"; }             # Debian's own, whatever else is in PATH

say "1. Install"
has_module=true
if [[ -z $packages && $source == /usr/share/doc/debond ]]; then
  scenes=/usr/share/debond/prm
  compgen -G "/usr/lib/python3/dist-packages/_debond*.so" > /dev/null || has_module=false
  unset PYTHONPATH
elif [[ -z $packages ]]; then
  [[ -x $build/debond ]] || fail "$build/debond is missing: build it (README.md), or name a directory with packages"
  export PATH=$build:$PATH PYTHONPATH=$build/python
  scenes=$source/prm
  compgen -G "$build/python/_debond*.so" > /dev/null || has_module=false
else
  wanted=("$packages"/debond_*.deb)
  [[ -e ${wanted[0]} ]] || fail "no debond_*.deb in $packages"
  if compgen -G "$packages/python3-debond_*.deb" > /dev/null; then
    wanted+=("$packages"/python3-debond_*.deb)
  else
    has_module=false
  fi
  if ((EUID == 0)) && ! $unpack; then
    # by hand, in the directory with the packages: apt install ./debond_*.deb ./python3-debond_*.deb
    DEBIAN_FRONTEND=noninteractive apt-get install --yes "${wanted[@]}"
    unset PYTHONPATH
    scenes=/usr/share/debond/prm
  else
    for package in "${wanted[@]}"; do dpkg-deb -x "$package" root; done
    export PATH=$PWD/root/usr/bin:$PATH PYTHONPATH=$PWD/root/usr/lib/python3/dist-packages
    scenes=$PWD/root/usr/share/debond/prm
  fi
fi
echo "$(debond --version) is $(command -v debond)"

# Scenes name their files from the directory that the program is started in.
ln -s "$scenes" prm

say "2. The first run: the paper's data set 1, calibrated"
debond prm/paper/data_set_1_calibrated.prm | tail -n 10
near "T_max [N mm]" "$(number output/data_set_1_calibrated/summary.json T_max_Nmm)" 53.8 1
near "T_inf [N mm]" "$(number output/data_set_1_calibrated/summary.json T_inf_Nmm)" 36.8 1

say "3. Look at it"
# xdg-open output/data_set_1_calibrated/report.html       curve, contact face, results in words
# head output/data_set_1_calibrated/torque.csv            the curve as numbers, for a spreadsheet
# paraview output/data_set_1_calibrated/interface.pvd     where the bond still holds: colour by phi
files output/data_set_1_calibrated/{report.html,torque.csv,maps.csv,interface.pvd,bulk.pvd,parameters.prm}

say "4. A scene of your own: what is in it, and what is as in prm/coin_mode3_fast.prm"
cat > my_implant.prm <<'END'
include prm/coin_mode3_fast.prm

set Title = My implant

subsection Bone
  set Size          = 15, 15, 6         # mm
  set Young modulus = 15000             # MPa
end

subsection Implant
  set Radius = 3                        # mm; of the contact face
  set Height = 4                        # mm; from the contact face to the chuck
end

subsection Interface                    # first guesses
  set Normal stiffness             = 600     # MPa/mm
  set Tangential stiffness  = 300     # MPa/mm
  set Friction coefficient broken   = 0.40
  set Friction coefficient unbroken = 0.60
  set Characteristic slip distance             = 0.030   # mm
  set Transition factor             = 0.75
end

subsection Chuck
  subsection Press
    set Control = force
    set Value   = 39.2 * min(t, 1)     # N; 4 kg, applied from time 0 to 1
  end
end

subsection Output
  set Directory = output/my_implant
end
END
# What an entry means:
debond --print-parameters | grep -B 4 "set Characteristic slip distance"
# What is to be expected, before anything is run:
debond --check my_implant.prm | tee check.log
has check.log "force 39.2 N"
# A mistake is answered by file, line, entry and what is allowed:
sed 's/set Radius /set Radios /' my_implant.prm > mistake.prm
if debond --check mistake.prm 2> mistake.log; then fail "mistake.prm was accepted"; fi
cat mistake.log
has mistake.log "mistake.prm:11"
rm mistake.prm
debond my_implant.prm | tail -n 10
# Nearly all of the face slides at the peak and at the end: 2/3 mu F R, with mu_ub and with mu_b.
near "T_max [N mm]" "$(number output/my_implant/summary.json T_max_Nmm)" 47.04 2
near "T_inf [N mm]" "$(number output/my_implant/summary.json T_inf_Nmm)" 31.36 2
files output/my_implant/{report.html,curve.csv}

say "5. Compare with a measured curve"
head -n 7 prm/tutorial/measured.csv # as the torque meter writes it; this one is made up
debond --compare output/my_implant prm/tutorial/measured.csv | tee compare.log
has compare.log "column 2 'Angle [deg]', column 3 'Torque [N m]'; 501 rows"
has compare.log "output/my_implant: 8." # % in the mean: the guesses are not that good yet

say "6. Fit the interface to it"
cat > my_fit.prm <<'END'
include my_implant.prm

set Title = My implant, fitted
set Task  = calibrate

subsection Interface                    # <<NAME: START in LOWER..UPPER>>; log: the order of magnitude is searched
  set Tangential stiffness  = <<eps_t: 300 in 100..3000 log>>
  set Friction coefficient broken   = <<mu_b: 0.4 in 0.1..1>>
  set Friction coefficient unbroken = <<mu_ub: 0.6 in 0.1..2>>
  set Characteristic slip distance             = <<a_s: 0.03 in 0.003..0.3 log>>
  set Transition factor             = <<b_s: 0.75 in 0.1..5 log>>
end

subsection Calibration
  set Angle offset       = <<angle_offset: 0 in -0.2..0.2>>   # degrees, shown when the implant begins to turn
  set Machine compliance = 0.002        # degrees per N mm, measured with a dummy
  set Torque offset      = 0.5          # N mm, shown without a load
end

subsection Output
  set Directory       = output/my_fit
  set Reference curve = prm/tutorial/measured.csv
end
END
debond --check my_fit.prm
debond my_fit.prm | tee fit.log
fitted() { awk -v name="$1" '$1 == name { print $2 }' fit.log; }
# what the curve was made with: prm/tutorial/make_measured.py
near mu_b "$(fitted mu_b)" 0.34 1
near mu_ub "$(fitted mu_ub)" 0.56 1
near "a_s [mm]" "$(fitted a_s)" 0.045 5
files output/my_fit/{report.html,calibration.json,fit.csv,fitted.prm}
# The fitted scene is ready to run:
debond output/my_fit/fitted.prm | tail -n 10
near "T_max [N mm] of the fit" "$(number output/my_fit/fitted/summary.json T_max_Nmm)" 43.904 2 # 2/3 mu_ub F R

say "7. Make a page anew"
rm output/my_fit/report.html
debond --report output/my_fit
files output/my_fit/report.html
has output/my_fit/report.html mu_ub

say "8. The same from Python"
if ! $has_module; then
  echo "There is no module: package python3-debond, or a build with pybind11-dev and python3-numpy."
else
  cat > my_script.py <<'END'
import debond
import numpy as np

result = debond.Scene("my_implant.prm").run()           # in memory: writes no files
angle, torque = result.rows["angle_deg"], result.rows["torque_Nmm"]
print("T_max", result.summary["T_max_Nmm"])             # N mm
print(np.column_stack([angle, torque])[::6].round(2))   # every sixth row: degrees, N mm

entry = "Interface/Friction coefficient unbroken"       # one entry changed, without another file
for mu_ub in (0.60, 0.66):
    summary = debond.Scene("my_implant.prm", {entry: mu_ub}).run().summary
    print("mu_ub", mu_ub, "T_max", summary["T_max_Nmm"])
END
  python3 my_script.py | tee script.log
  peak=$(number output/my_implant/summary.json T_max_Nmm)
  ratio() { awk -v peak="$peak" "$1" script.log; }
  near "T_max from Python over that of the program" "$(ratio '/^T_max/ { print $2 / peak }')" 1 0.001
  # a tenth more mu_ub, a tenth more T_max: doc/tutorial/your_test.md
  near "T_max with a tenth more mu_ub over T_max" "$(ratio '/^mu_ub 0.66/ { print $4 / peak }')" 1.1 0.5
  used=$(python3 -c 'import _debond; print(_debond.__file__)')
  [[ $used == "${PYTHONPATH:-/usr/lib/python3/dist-packages}"/* ]] || fail "Python has used $used"
fi

cat <<END

Everything was right. Open in a browser:
  $PWD/output/data_set_1_calibrated/report.html
  $PWD/output/my_implant/report.html
  $PWD/output/my_fit/report.html
in ParaView:
  $PWD/output/data_set_1_calibrated/interface.pvd
and change my_implant.prm, my_fit.prm and my_script.py there. The next thing to read is doc/tutorial/index.md.
END
