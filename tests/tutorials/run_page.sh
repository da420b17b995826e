#!/usr/bin/env bash
# run_page.sh PAGE.md BUILD_DIR SCRATCH_DIR: does what a page of docs/tutorials tells its reader to do, in a scratch
# folder that looks like the root of the source tree with the program in build/release, and compares what the page shows.
#
# What a fenced block is, by the words behind its three back quotes:
#   sh              commands. All blocks of a page run in one shell, in order; no command may fail,
#   sh fails        but here one must.
#   text            what the block of commands above it prints: every line, in order. `...` stands for any text, and alone
#                   in a line for any lines. Other figures and other blanks will do, so that a page shows a real flight;
#   text exact      here they will not.
#   LANGUAGE FILE   a file the reader writes, as in "xml hop.xml".
# Anything else fails, so that nothing on a page is left out. The page's port 8080 is a free one here.
set -euo pipefail
shopt -s extglob
page=$1 build=$2 scratch=$3
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

comparable() {
  if [ "$1" = 'text exact' ]; then cat; else sed -E 's/[0-9]+(\.[0-9]+)?/0/g; s/-{4,}/---/g; s/[[:blank:]]+/ /g'; fi |
    sed -E 's/[[:space:]]+$//; s/^ //'
}

# compare WORDS EXPECTED PRINTED
compare() {
  local pattern='' want newline=$'\n'
  while IFS= read -r want; do
    if [ "$want" = '...' ]; then
      pattern+='*'
    else
      want=$(printf '%s' "$want" | sed 's/[][\\*?()|!@+]/\\&/g')
      pattern+=$newline${want//.../*([!$newline])}
    fi
  done < <(comparable "$1" <"$2")
  # shellcheck disable=SC2053 -- it is a pattern
  [[ $newline$(comparable "$1" <"$3") == $pattern ]] && return
  diff <(comparable "$1" <"$2") <(comparable "$1" <"$3") || true
  return 1
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
    text | 'text exact')
      compare "$words" "$block.body" "$shown" || { echo '--- printed'; cat "$shown"; fail 'prints something else'; } ;;
    *' '*)
      mkdir -p "$(dirname "${words#* }")"
      cp "$block.body" "${words#* }" ;;
    *) fail "is this a command, what it prints, or a file? \`$words\`" ;;
  esac
done
[ $commands -gt 0 ] || fail 'nothing was run'
cd /
rm -rf "$scratch" "$scratch.blocks"
echo "$commands blocks of commands did what $(basename "$page") says."
