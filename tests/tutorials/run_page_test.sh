#!/usr/bin/env bash
# run_page_test.sh SCRATCH_DIR: run_page.sh passes a true page and fails each page that is wrong.
set -euo pipefail
run=$(dirname "$(readlink -f "$0")")/run_page.sh scratch=$1
mkdir -p "$scratch"
command -v curl >/dev/null || exit 77

# try EXIT_CODE NAME [--write]: the page comes on stdin, with ~~~ for back quotes.
try() {
  sed 's/^~~~/```/' >"$scratch/$2.md"
  local code=0
  "$run" ${3:-} "$scratch/$2.md" "$scratch" "$scratch/$2" >"$scratch/$2.log" 2>&1 || code=$?
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
key: 1.6
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
try 0 figures_within_a_tenth <<<$'~~~sh\necho "109 m  0.014"; echo "---------"\n~~~\n~~~text\n100 m 0.013\n---\n~~~'
try 1 a_figure_beyond_a_tenth <<<$'~~~sh\necho 111 m\n~~~\n~~~text\n100 m\n~~~'
try 1 another_count <<<$'~~~sh\necho 2 losses\n~~~\n~~~text\n1 losses\n~~~'
try 0 a_wider_tolerance <<<$'~~~sh\necho 140 m\n~~~\n~~~text within 50%\n100 m\n~~~'
try 1 beyond_a_wider_tolerance <<<$'~~~sh\necho 160 m\n~~~\n~~~text within 50%\n100 m\n~~~'
try 0 any_text <<<$'~~~sh\necho "done after 3.1 s, 17 x"; echo 5; echo 6\n~~~\n~~~text\ndone after ... s, ... x\n...\n6\n~~~'
try 1 another_order <<<$'~~~sh\nseq 3\n~~~\n~~~text\n...\n3\n...\n2\n...\n~~~'
try 1 nothing_printed <<<$'~~~sh\ntrue\n~~~\n~~~text\n1\n~~~'
try 1 a_line_too_few <<<$'~~~sh\nseq 2\n~~~\n~~~text\n1\n~~~'
try 1 a_line_too_many <<<$'~~~sh\nseq 2\n~~~\n~~~text\n1\n2\n3\n~~~'
try 1 unknown_block <<<$'~~~sh\ntrue\n~~~\n~~~python\nprint()\n~~~'
try 1 nothing_to_run <<<$'Words only.'

# A page that is written anew has the printed figures, and keeps its words and its `...`.
try 0 written --write <<<$'~~~sh\necho "  7.5 m in 3 s at 8080"; echo 9\n~~~\n~~~text\n1.0 m in ... s at 8080\n...\n~~~\nWords of 1.0 m.'
printf '%s\n' '```sh' 'echo "  7.5 m in 3 s at 8080"; echo 9' '```' '```text' '  7.5 m in ... s at 8080' '...' '```' \
  'Words of 1.0 m.' | diff - "$scratch/written.md"
try 1 other_words_are_not_written --write <<<$'~~~sh\necho done\n~~~\n~~~text\ngone\n~~~'
rm -rf "$scratch"
echo 'All pages judged rightly.'
