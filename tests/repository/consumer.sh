#!/usr/bin/env bash
# consumer.sh BUILD_DIR SCRATCH_DIR: installs the build into a scratch folder and builds examples/consumer against it, as
# a project elsewhere would; the source tree must not be needed.
set -euo pipefail
source_dir=$(cd "$(dirname "$0")/../.." && pwd) build=$1 scratch=$2
rm -rf "$scratch"
mkdir -p "$scratch"
fail() { echo "FAILED: $*" >&2; exit 1; }

if grep -q '^SWIFTLET_SANITIZE:[A-Z]*=.' "$build/CMakeCache.txt"; then
  echo 'skipped: a program built outside cannot link libraries that were built with sanitizers'
  exit 77
fi
cmake --install "$build" --prefix "$scratch/stage" >"$scratch/install.log" || { cat "$scratch/install.log"; exit 1; }
cp -r "$source_dir/examples/consumer" "$scratch/consumer"
configure() {
  cmake -S "$scratch/consumer" -B "$scratch/build" -G Ninja -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_PREFIX_PATH="$scratch/stage" "$@"
}
configure >"$scratch/configure.log" 2>&1 || { cat "$scratch/configure.log"; fail 'find_package(swiftlet)'; }
cmake --build "$scratch/build" || fail 'building the consumer'
answer=$("$scratch/build/data_sheet" "$scratch/consumer/vehicle.yaml")
[ "$answer" = 'sparrow: hull radius 0.200 m, thrust to weight 2.04' ] || fail "data_sheet said: $answer"

# Nothing the consumer compiled may have come from the source tree.
if grep -rqE "$source_dir/(common|behaviors)" "$scratch/stage/lib/cmake" "$scratch/build/build.ninja"; then
  fail 'the installed package points into the source tree'
fi

# All components together, so that every dependency a component names is one that can be found.
sed -i 's/ COMPONENTS common//' "$scratch/consumer/CMakeLists.txt"
configure >"$scratch/all.log" 2>&1 || { cat "$scratch/all.log"; fail 'find_package(swiftlet) with all components'; }

# A component that does not exist is named.
sed -i 's/swiftlet REQUIRED/swiftlet REQUIRED COMPONENTS teleport/' "$scratch/consumer/CMakeLists.txt"
if configure >"$scratch/unknown.log" 2>&1; then fail 'an unknown component was found'; fi
grep -q 'there is no component teleport' "$scratch/unknown.log" || { cat "$scratch/unknown.log"; fail 'unknown component'; }
echo 'The installed package works for a project elsewhere.'
