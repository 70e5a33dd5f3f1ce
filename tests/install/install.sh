#!/bin/bash
# install.sh BUILD EXAMPLE: installs the program, runs one of its scenes, follows the links of its pages, and builds a
# program of one's own with find_package(debond). Prints what must be so.
set -eu
build=$1 example=$2 links=$(dirname "$(realpath "$0")")/links.pl
mkdir work && cd work # ctest writes into a file output
cmake --install "$build" --prefix "$PWD/installed" > log
ls installed/bin installed/share/man/man1 | grep debond
cp -r installed/share/debond/prm .
installed/bin/debond prm/coin_mode3_fast.prm > log
grep -o "Largest torque 53" log
ls output/coin_fast/report.html
grep -c "^# " installed/share/doc/debond/README.md
(cd installed/share/doc/debond && ls doc/first_steps.sh doc/tutorial/index.md prm/coin_mode3.prm python/tutorial.ipynb)
"$links" installed/share/doc/debond

mkdir own && cp "$example" own/own.cc
cat > own/CMakeLists.txt <<'END'
cmake_minimum_required(VERSION 3.25)
project(own CXX)
find_package(debond REQUIRED)
add_executable(own own.cc)
target_link_libraries(own debond::debond_library)
END
cmake -S own -B own/build -DCMAKE_PREFIX_PATH="$PWD/installed" -DCMAKE_BUILD_TYPE=Release > log 2>&1 || cat log
cmake --build own/build > log 2>&1 || cat log
own/build/own | tail -n 1 | cut -c1-10
