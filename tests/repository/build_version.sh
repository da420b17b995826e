#!/usr/bin/env bash
# build_version.sh SCRATCH_DIR: what cmake/BuildVersion.cmake makes of a checkout, of a changed one and of no checkout.
# Exit 77 (skipped) where there is no git.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd) scratch=$1
command -v git >/dev/null || { echo 'skipped: no git'; exit 77; }
rm -rf "$scratch"
mkdir -p "$scratch/sources" "$scratch/empty"
scratch=$(cd "$scratch" && pwd)
cd "$scratch/sources"

generated=$scratch/build_version.cpp
write() { cmake -DNUMBER=1.2.3 "-DSOURCE=$1" "-DOUTPUT=$generated" "${@:2}" -P "$root/cmake/BuildVersion.cmake"; }
# expect WHAT COMMIT DIRTY
expect() {
  grep -qF "kVersion{\"1.2.3\", \"$2\", $3}" "$generated" || { echo "FAILED: $1"; cat "$generated"; exit 1; }
}
commit() { git -c user.name=a -c user.email=a@localhost commit -qam "$1"; git rev-parse HEAD | cut -c1-12; }

# The scratch folder may lie inside of a checkout: what is there is not the commit of these sources.
git -C "$scratch" init -q
echo 1 >one.cpp
write "$scratch/sources"
expect 'an archive inside of a checkout' unknown std::nullopt

git init -q
write "$scratch/sources"
expect 'a checkout without a commit' unknown std::nullopt

printf '/build/\n' >.gitignore
git add .
first=$(commit one)
write "$scratch/sources"
expect 'a clean checkout' "$first" false

touch -d '2020-01-01' "$generated"
write "$scratch/sources"
[ "$(date -r "$generated" +%Y)" = 2020 ] || { echo 'FAILED: an unchanged version was written again'; exit 1; }

mkdir build && touch build/made.cpp notes.txt
write "$scratch/sources"
expect 'what is ignored and what is not built is no change' "$first" false
touch two.cpp
write "$scratch/sources"
expect 'a new source is a change' "$first" true
rm two.cpp
echo 2 >one.cpp
write "$scratch/sources"
expect 'an edited source is a change' "$first" true

second=$(commit two)
write "$scratch/sources"
expect 'the next commit' "$second" false
git worktree add -q "$scratch/worktree"
write "$scratch/worktree"
expect 'a worktree' "$second" false
ln -s sources "$scratch/link"
write "$scratch/link"
expect 'a checkout behind a symbolic link' "$second" false
write "$scratch/sources" -DCMAKE_FIND_ROOT_PATH=/nowhere -DCMAKE_FIND_ROOT_PATH_MODE_PROGRAM=ONLY
expect 'a machine without git' unknown std::nullopt
echo 'What is built is told.'
