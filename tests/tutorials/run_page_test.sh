#!/usr/bin/env bash
# run_page_test.sh SCRATCH_DIR: run_page.sh lets a true page pass and none that is wrong.
set -euo pipefail
run=$(dirname "$(readlink -f "$0")")/run_page.sh scratch=$1
mkdir -p "$scratch"
command -v curl >/dev/null || exit 77

# try EXIT_CODE NAME: the page comes on stdin, with ~~~ for back quotes.
try() {
  sed 's/^~~~/```/' >"$scratch/$2.md"
  local code=0
  "$run" "$scratch/$2.md" "$scratch" "$scratch/$2" >"$scratch/$2.log" 2>&1 || code=$?
  [ $code = "$1" ] || { cat "$scratch/$2.log"; echo "FAILED: $2: exit code $code instead of $1" >&2; exit 1; }
}

try 0 true_page <<'PAGE'
Words.
~~~yaml folder/a.yaml
key: 1.5
~~~
~~~sh
cat folder/a.yaml && x=7
seq 3
~~~
~~~text
key: 2
...
3
~~~
~~~sh fails
echo "$x [ok]" && false
~~~
~~~text exact
7 [ok]
~~~
PAGE
try 1 command_fails <<<$'~~~sh\nfalse\ntrue\n~~~'
try 1 command_does_not_fail <<<$'~~~sh fails\ntrue\n~~~'
try 1 other_words <<<$'~~~sh\necho done\n~~~\n~~~text\ngone\n~~~'
try 1 other_figures <<<$'~~~sh\necho 7\n~~~\n~~~text exact\n8\n~~~'
try 1 a_line_too_few <<<$'~~~sh\nseq 2\n~~~\n~~~text\n1\n~~~'
try 1 a_line_too_many <<<$'~~~sh\nseq 2\n~~~\n~~~text\n1\n2\n3\n~~~'
try 1 unknown_block <<<$'~~~sh\ntrue\n~~~\n~~~python\nprint()\n~~~'
try 1 nothing_to_run <<<$'Words only.'
rm -rf "$scratch"
echo 'Nine pages judged rightly.'
