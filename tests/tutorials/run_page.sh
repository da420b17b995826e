#!/usr/bin/env bash
# run_page.sh [--write] PAGE.md BUILD_DIR SCRATCH_DIR: does what a page of docs/tutorials tells its reader to do, in a
# scratch folder that looks like the root of the source tree with the program in build/release, and compares what the page
# shows with what was printed. With --write the page gets the figures that were printed; nobody types them.
#
# The words after the three back quotes say what a fenced block is:
#   sh               Commands. All blocks of a page run in one shell, in order. No command may fail.
#   sh fails         Commands of which one must fail.
#   text             What the block of commands above it prints, every line in order. `...` stands for any text, and alone
#                    in a line for any lines. A figure may differ by a tenth (compare.awk has the details). What depends
#                    on the machine, such as computing time, is shown as `...`.
#   text within 50%  The same, with another tolerance.
#   text exact       Every character counts.
#   LANGUAGE FILE    A file that the reader writes, as in "xml hop.xml".
# Any other block fails, so that nothing on a page is left out. The page's port 8080 is a free one here.
set -euo pipefail
write=0
[ "$1" = --write ] && { write=1; shift; }
page=$(realpath "$1") build=$(realpath "$2") scratch=$(realpath -m "$3")
source_dir=$(cd "$(dirname "$0")/../.." && pwd)
command -v curl >/dev/null || { echo 'curl is not installed'; exit 77; }
export SWIFTLET_DATASETS=${SWIFTLET_DATASETS:-$source_dir/../shared/datasets}
if grep -q SWIFTLET_DATASETS "$page" && [ ! -d "$SWIFTLET_DATASETS" ]; then
  echo "skipped: no data set $SWIFTLET_DATASETS; set SWIFTLET_DATASETS"
  exit 77
fi

rm -rf "$scratch"
mkdir -p "$scratch/build" "$scratch.blocks"
rm -f "$scratch.blocks"/*
for entry in "$source_dir"/*; do
  case $(basename "$entry") in build | runs) ;; *) ln -s "$entry" "$scratch/" ;; esac
done
ln -s "$build" "$scratch/build/release"

port=$((20000 + RANDOM % 30000))
while (: <"/dev/tcp/127.0.0.1/$port") 2>/dev/null; do port=$((port + 1)); done

# Each block becomes a file LINE, of which the first line is the words behind the back quotes.
sed "s/\b8080\b/$port/g" "$page" | awk -v blocks="$scratch.blocks" '
  /^```/ { if (file) { close(file); file = "" } else { file = sprintf("%s/%04d", blocks, NR); print substr($0, 4) > file }
           next }
  file { print > file }'

fail() { echo "FAILED: $page:$((10#$line)): $*" >&2; exit 1; }

# compare WORDS SHOWN PRINTED: prints SHOWN with the figures of PRINTED.
compare() {
  local within=0.1 exact=0
  case $1 in
    'text exact') exact=1 ;;
    'text within '*%) within=$(awk -v share="${1#text within }" 'BEGIN { print share / 100 }') ;;
  esac
  [ $write = 1 ] && within=1e9
  awk -v within="$within" -v exact="$exact" -f "$source_dir/tests/tutorials/compare.awk" "$2" "$3"
}

trap 'jobs -p | xargs -r kill 2>/dev/null || true' EXIT
cd "$scratch"
shown="$scratch.blocks/printed" commands=0 language='' words='' line=''
: >"$shown"
for block in "$scratch.blocks"/[0-9]*; do
  line=$(basename "$block")
  words=$(head -n 1 "$block")
  tail -n +2 "$block" >"$block.body"
  case $words in
    sh | 'sh fails')
      failed=0
      set +euo pipefail
      trap 'failed=1' ERR
      # shellcheck disable=SC1090
      source "$block.body" >"$shown" 2>&1
      trap - ERR
      set -euo pipefail
      [ "$words" = sh ] && [ $failed = 1 ] && { cat "$shown"; fail 'a command failed'; }
      [ "$words" = 'sh fails' ] && [ $failed = 0 ] && { cat "$shown"; fail 'no command failed'; }
      commands=$((commands + 1)) ;;
    text | 'text exact' | 'text within '*%)
      compare "$words" "$block.body" "$shown" >"$block.now" ||
        { echo '--- printed'; cat "$shown"; fail 'prints something else'; } ;;
    *' '*)
      mkdir -p "$(dirname "${words#* }")"
      cp "$block.body" "${words#* }" ;;
    *) fail "is this a command, what it prints, or a file? \`$words\`" ;;
  esac
done
[ $commands -gt 0 ] || fail 'nothing was run'
cd /
if [ $write = 1 ]; then
  awk -v blocks="$scratch.blocks" -v port="$port" '
    /^```/ && shows { shows = 0 }
    shows { next }
    { print }
    /^```text/ { shows = 1; file = sprintf("%s/%04d.now", blocks, NR)
                 while ((getline line < file) > 0) { gsub(port, "8080", line); print line } }
    ' "$page" >"$page.now"
  cat "$page.now" >"$page"
  rm "$page.now"
fi
rm -rf "$scratch" "$scratch.blocks"
echo "$commands blocks of commands did what $(basename "$page") says."
