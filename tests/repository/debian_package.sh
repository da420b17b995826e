#!/usr/bin/env bash
# debian_package.sh BUILD_DIR SCRATCH_DIR: packs the build by CPack, reads the packages as dpkg would and runs what is
# inside. Exit 77 (skipped) where there is no dpkg-shlibdeps.
set -euo pipefail
build=$1 scratch=$2
fail() { echo "FAILED: $*" >&2; exit 1; }
command -v dpkg-shlibdeps >/dev/null || { echo 'skipped: no dpkg-shlibdeps (Debian: dpkg-dev)'; exit 77; }
rm -rf "$scratch"
mkdir -p "$scratch"

# Packing fast matters more here than packing small.
cpack --config "$build/CPackConfig.cmake" -B "$scratch" -D CPACK_DEBIAN_COMPRESSION_TYPE=zstd >"$scratch/cpack.log" 2>&1 ||
  { cat "$scratch/cpack.log"; fail 'cpack'; }

develop=$(echo "$scratch"/swiftlet-dev_*.deb)
[ "$(dpkg-deb -f "$develop" Package)" = swiftlet-dev ] || fail "no swiftlet-dev in $scratch"
dpkg-deb -c "$develop" >"$scratch/develop.txt"
grep -q '/usr/include/swiftlet/common/time.hpp' "$scratch/develop.txt" || fail 'swiftlet-dev has no headers'
grep -q '/libswiftlet_common.a' "$scratch/develop.txt" || fail 'swiftlet-dev has no libraries'

for package in libeigen3-dev libceres-dev nlohmann-json3-dev; do
  [[ $(dpkg-deb -f "$develop" Depends) == *$package* ]] || fail "swiftlet-dev does not depend on $package"
done

program=$(echo "$scratch"/swiftlet_*.deb)
[ "$(dpkg-deb -f "$program" Package)" = swiftlet ] || fail "no swiftlet in $scratch"
dpkg-deb -c "$program" >"$scratch/program.txt"
for file in doc/swiftlet/copyright doc/swiftlet/docs/tutorials/first_flight.md man/man1/swiftlet.1.gz; do
  grep -q "/usr/share/$file" "$scratch/program.txt" || fail "swiftlet has no $file"
done
if [ -x "$build/swiftlet" ]; then
  depends=$(dpkg-deb -f "$program" Depends)
  [[ $depends == *libc6* ]] || fail 'swiftlet depends on nothing'
  [[ $depends != *atlas* ]] || fail "swiftlet needs ATLAS: $depends"
  dpkg-deb -x "$program" "$scratch/root"
  cd / # Away from the source tree's folders: the program must find its own.
  swiftlet=$scratch/root/usr/bin/swiftlet
  "$swiftlet" version || fail 'the packed program does not start'
  gzip -dc "$scratch/root/usr/share/man/man1/swiftlet.1.gz" >"$scratch/swiftlet.1"
  for command in $("$swiftlet" --help | sed -n '/^Subcommands:/,/^$/s/^  \([a-z0-9]*\) .*/\1/p'); do
    grep -q "^\.SS swiftlet $command\$" "$scratch/swiftlet.1" || fail "the man page has no $command"
    grep -q "^swiftlet $command" "$scratch/swiftlet.1" || fail "the man page has no example of $command"
  done
  if command -v groff >/dev/null; then
    warnings=$(groff -man -ww -z "$scratch/swiftlet.1" 2>&1)
    [ -z "$warnings" ] || fail "the man page: $warnings"
  fi
  "$swiftlet" check missions/explore_and_return.xml || fail 'the packed program does not find its data'
fi
echo "Packed: $(cd "$scratch" && du -h ./*.deb | tr '\n' ' ')"
