#!/usr/bin/env bash
# licences.sh PROGRAM: docs/licences.md names what the program links, what the build installs, and what comes from npm,
# no library that is not linked, and the packages that CMake files name as optional.
set -euo pipefail
program=$1
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
page=docs/licences.md failed=0
fail() { echo "FAILED: $*" >&2; failed=1; }
on_page() { grep -qE "(^|[ |\`])$(sed 's/[.+]/\\&/g' <<<"$1")([ ,;|\`]|\$)" "$page"; }

# The C and C++ runtime is named in one row.
linked=$(objdump -p "$program" | awk '$1 == "NEEDED" { print $2 }' | grep -v '^ld-linux')
for library in $linked; do
  on_page "$library" || fail "$page does not name $library, which the program links"
done
for library in $(grep -oE '^\| `[^|]*' "$page" | grep -oE 'lib[A-Za-z0-9_.+-]+\.so[.0-9]*'); do
  grep -qxF "$library" <<<"$linked" || [ "$library" = libzmq.so.5 ] || fail "$page names $library, which the program does not link"
done
for package in $(sed 's/#.*//; /^\[/d' scripts/packages.txt | awk 'NF { print $1 }'); do
  on_page "$package" || fail "$page does not name the package $package"
done
# Those that are used where they happen to be installed, by what the build says of them.
for package in $(grep -rhoE '\<lib[a-z0-9-]+-dev\>' --include=CMakeLists.txt --include='*.cmake' . | sort -u); do
  on_page "$package" || fail "$page does not name the package $package, which a CMake file asks for"
done
command -v node >/dev/null || exit $failed
for package in $(find . -name node_modules -prune -o -path ./build -prune -o -name package.json -print | xargs -r node -p '
    process.argv.slice(1).flatMap((file) => { const { dependencies, devDependencies } = JSON.parse(fs.readFileSync(file));
      return Object.keys({ ...dependencies, ...devDependencies }); }).join(" ")'); do
  on_page "$package" || fail "$page does not name $package, which comes from npm"
done
exit $failed
