#!/bin/bash
# package.sh PACKAGES           looks into the packages in this directory, and runs the program
# package.sh PACKAGES EXAMPLE   makes a Debian like this one, installs the packages there, runs the first scene as a user,
#                               and builds a program of one's own; needs root, debootstrap and 4 GB
# Prints what must be so.
set -eu
here=$(dirname "$(realpath "$0")")
packages=$1 example=${2:-} links=$here/../install/links.pl
. "$here/tree.sh"
# what is mounted is gone with this process
if [[ -n $example && -z ${DEBOND_UNSHARED:-} ]]; then DEBOND_UNSHARED=1 exec unshare --mount "$0" "$@"; fi
mkdir work && cd work # ctest writes into a file output
program=$(ls "$packages"/debond_*.deb) library=$(ls "$packages"/libdebond-dev_*.deb)

if [[ -z $example ]]; then
  dpkg-deb -f "$program" Package Recommends
  dpkg-deb -f "$program" Depends | grep -oE "\b(libdeal.ii-9|libopenblas0|libpng16-16)(t64)?\b" | sed s/t64// | sort
  dpkg-deb -x "$program" root
  dpkg-deb -x "$library" root
  (cd root/usr/share/doc && ls debond/{README.md,README.Debian} {debond,libdebond-dev}/{copyright,changelog.Debian.gz})
  (cd root/usr/share/doc/debond && ls doc/first_steps.sh doc/tutorial/index.md prm/coin_mode3.prm python/tutorial.ipynb && readlink LICENSE)
  find root -name libdebond_library.a -o -name debondConfig.cmake -o -name scene.h | sed 's|.*/||' | sort
  zgrep -o "debond .- simulate" root/usr/share/man/man1/debond.1.gz
  echo "libraries loaded for nothing: $(ldd -u root/usr/bin/debond | grep -c /)"
  ln -s root/usr/share/debond/prm
  root/usr/bin/debond prm/coin_mode3_fast.prm > log
  grep -o "Largest torque 53" log
  exit
fi

make_tree "$(. /etc/os-release && echo "$VERSION_CODENAME")" # packages are of the Debian that they were made on
cp "$program" "$library" "$tree/tmp"
cp "$example" "$tree/tmp/own.cc"

install man-db python3-jinja2 "/tmp/$(basename "$program")"
"$links" "$tree/usr/share/doc/debond"
inside "$tree" useradd --create-home user
inside --userspec=user:user "$tree" env HOME=/home/user sh -euc '
  cd
  ln -s /usr/share/debond/prm && ln -s /usr/share/doc/debond/doc
  debond prm/paper/data_set_1_calibrated.prm | grep -o "Largest torque [0-9]*"
  DEBOND=/usr/bin/debond doc/paper/reproduce.sh table_1 | grep -c "Closed forms predict"
  rm output/data_set_1_calibrated/report.html
  debond --report output/data_set_1_calibrated
  ls output/data_set_1_calibrated/report.html
  man debond | grep -o "simulate how .*"'
install cmake make g++ "/tmp/$(basename "$library")"
inside --userspec=user:user "$tree" env HOME=/home/user sh -euc '
  mkdir ~/own && cd ~/own && cp /tmp/own.cc .
  cat > CMakeLists.txt <<END
cmake_minimum_required(VERSION 3.25)
project(own CXX)
find_package(debond REQUIRED)
add_executable(own own.cc)
target_link_libraries(own debond::debond_library)
END
  (cmake -B build -DCMAKE_BUILD_TYPE=Release && cmake --build build) > log 2>&1 || (cat log && exit 1)
  cd
  own/build/own | tail -n 1 | cut -c1-10'
