#!/usr/bin/env bash
# Installs a build into a temporary folder and lets a project outside the tree find it, by CMake and by pkg-config, add a
# force element of its own and run a lift.
#   embedding_test.sh BUILD SOURCES COMPILER
set -euo pipefail
build=$1 sources=$2 compiler=$3
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

cmake --install "$build" --prefix "$folder/installed" > "$folder/install.log" 2>&1 || { cat "$folder/install.log"; exit 1; }
# Moved, since a package must not remember where it was installed first.
mv "$folder/installed" "$folder/moved"
cp -r "$sources" "$folder/project"

cmake -S "$folder/project" -B "$folder/cmake" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER="$compiler" \
  -DCMAKE_PREFIX_PATH="$folder/moved" > "$folder/cmake.log" 2>&1 || { cat "$folder/cmake.log"; exit 1; }
cmake --build "$folder/cmake"
"$folder/cmake/lift_with_wind"

export PKG_CONFIG_PATH=$(dirname "$(find "$folder/moved" -name stillhook.pc)")
"$compiler" -std=c++20 -O1 "$folder/project/lift_with_wind.cpp" -o "$folder/by_pkg_config" \
  $(pkg-config --cflags --libs --static stillhook)
"$folder/by_pkg_config"

# A component that is not there is said to be missing, and a foreign build inherits no warnings of ours.
sed 's/COMPONENTS planner/COMPONENTS nonsense/' "$folder/project/CMakeLists.txt" > "$folder/CMakeLists.txt"
mv "$folder/CMakeLists.txt" "$folder/project/CMakeLists.txt"
if cmake -S "$folder/project" -B "$folder/missing" -DCMAKE_PREFIX_PATH="$folder/moved" > "$folder/missing.log" 2>&1; then
  echo "a component that does not exist was found"; exit 1
fi
grep -q nonsense "$folder/missing.log"
if grep -rq -- "-Werror\|-Wshadow" "$folder/moved/lib"; then echo "the package exports warnings"; exit 1; fi
