#!/usr/bin/env bash
# man_page.sh PROGRAM VERSION: the man page of swiftlet (section 1), made of what its commands print with --help.
set -euo pipefail
program=$1 version=$2

# The help of one command as roff: `words` is its name.
page_of() { # WORDS...
  "$program" "$@" --help | awk -v words="$*" '
    function roff(text) {            # What roff would take for its own.
      gsub(/\\/, "\\e", text); gsub(/-/, "\\-", text)
      return text ~ /^[.'"'"']/ ? "\\&" text : text
    }
    function item(name, text) { print ".TP\n.B " roff(name); if (text != "") print roff(text) }
    NR == 1 { print ".SS " (words == "" ? "Options of every command" : "swiftlet " words); print roff($0); next }
    /^Usage: / { if (words != "") { sub(/^Usage: /, ""); print ".PP\n.B " roff($0) } next }
    /^(Positionals|Options):$/ { section = $1; next }
    /^Subcommands:$/ { section = "none"; next }
    /^Example: / { section = ""; if (words != "") { sub(/^Example: /, ""); print ".PP\nExample:\n.PP\n.RS\n.nf\n" roff($0) "\n.fi\n.RE" } next }
    section == "none" || NF == 0 { next }
    /^  -h,--help / && words != "" { next }      # Said once, for all.
    /^  [^ ]/ {
      at = match(substr($0, 3), /  +[^ ]/)
      if (at) { text = substr($0, at + 2); sub(/^ +/, "", text); item(substr($0, 3, at - 1), text) } else item(substr($0, 3), "")
      next
    }
    { sub(/^ +/, ""); print (section == "" && words != "" ? ".PP\n" : "") roff($0) }'
}
# The commands that a command has.
commands_of() { "$program" "$@" --help | awk '/^Subcommands:$/ { found = 1; next } found && /^  [^ ]/ { print $1 } found && !NF { exit }'; }

cat <<EOF
.\" Made by cmake/man_page.sh from --help.
.TH SWIFTLET 1 "" "Swiftlet $version" "User Commands"
.SH NAME
swiftlet \\- $("$program" --help | sed -n '1{s/-/\\-/g;p}')
.SH SYNOPSIS
.B swiftlet
.I command
.RI [ arguments ]
.SH DESCRIPTION
Missions, worlds, profiles and trials that are shipped are found by their names, as in
.BR missions/explore_and_return.xml ,
from any folder. Each command says with
.B \\-\\-help
what it takes.
.SH COMMANDS
EOF
for command in $(commands_of); do
  page_of "$command"
  for below in $(commands_of "$command"); do page_of "$command" "$below"; done
done
page_of
cat <<'EOF'
.SH EXIT STATUS
.TP
.B 0
The command did what it is for.
.TP
.B 1
It ran, but not to the wished end: a mission that failed, a trial that missed its criteria.
.TP
.B 2
Wrong usage, or input that cannot be used.
.SH ENVIRONMENT
.TP
.B SWIFTLET_DATA
The folder with missions, worlds, config and trials, instead of the installed one.
.TP
.B SDF_PATH
Folders in which worlds look for models, separated by colons.
.SH FILES
.TP
.I /usr/share/swiftlet
Missions, worlds, profiles and trials.
.TP
.I /usr/share/doc/swiftlet/docs
Tutorials and reference.
EOF
