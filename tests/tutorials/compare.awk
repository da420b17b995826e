# awk -v within=SHARE [-v exact=1] -f compare.awk SHOWN PRINTED: is what a page shows what was printed?
#
# `...` in SHOWN stands for any text, and alone in a line for any lines. Every other line must be printed, in order. Runs
# of blanks and rules of dashes may have another length. A figure may differ by the share `within` of the shown one; a
# figure with decimals may always differ by one in its last place. With exact=1 every character counts.
#
# Prints SHOWN with the figures of PRINTED and exits with 0. If they differ, it names the line on stderr and exits with 1.
BEGIN { NONE = "\001" }
{ sub(/[ \t\r]+$/, "") }
FILENAME == ARGV[1] { shown[++n_shown] = $0; next }
{ printed[++n_printed] = $0 }

function near(shown_figure, printed_figure,   difference, point, allowed) {
  difference = shown_figure - printed_figure
  if (difference < 0) difference = -difference
  allowed = within * shown_figure
  point = index(shown_figure, ".")
  if (point && allowed < 10 ^ (point - length(shown_figure))) allowed = 10 ^ (point - length(shown_figure))
  return difference <= allowed * 1.000001
}

# The text `want` with the figures of `got`, or NONE where they differ.
function merged(want, got,   out, i, rest, part, other) {
  out = ""
  while (want != "") {
    if (substr(want, 1, 3) == "...") {
      for (i = 1; i <= length(got) + 1; i++) {
        rest = merged(substr(want, 4), substr(got, i))
        if (rest != NONE) return out "..." rest
      }
      return NONE
    }
    part = head(want)
    other = head(got)
    if (part != other && (exact || !alike(part, other))) return NONE
    out = out other
    want = substr(want, length(part) + 1)
    got = substr(got, length(other) + 1)
  }
  return got == "" ? out : NONE
}

# The figure, run of blanks, rule of dashes or character that a text begins with.
function head(text) {
  if (!exact && (match(text, /^[0-9]+(\.[0-9]+)?/) || match(text, /^[ \t]+/) || match(text, /^---+/)))
    return substr(text, 1, RLENGTH)
  return substr(text, 1, 1)
}

function alike(part, other) {
  if (part ~ /^[0-9]/) return other ~ /^[0-9]/ && near(part, other)
  return (part ~ /^[ \t]/ && other ~ /^[ \t]/) || (part ~ /^---/ && other ~ /^---/)
}

function mergedLine(want, got,   indent, rest) {
  if (exact) return merged(want, got)
  match(got, /^[ \t]*/)
  indent = substr(got, 1, RLENGTH)
  got = substr(got, RLENGTH + 1)
  match(want, /^[ \t]*/)
  if (substr(want, RLENGTH + 1, 3) == "...") indent = substr(want, 1, RLENGTH)
  rest = merged(substr(want, RLENGTH + 1), got)
  return rest == NONE ? NONE : indent rest
}

END {
  i = j = farthest = 1
  gap = 0  # The last line `...`; when a line after it differs, it takes in one printed line more.
  while (j <= n_printed) {
    if (i > farthest) farthest = i
    line = i <= n_shown && shown[i] != "..." ? mergedLine(shown[i], printed[j]) : NONE
    if (i <= n_shown && shown[i] == "...") {
      gap = i++
      taken = j
    } else if (line != NONE) {
      shown_now[i++] = line
      j++
    } else if (gap) {
      i = gap + 1
      j = ++taken
    } else {
      break
    }
  }
  if (i > farthest) farthest = i
  while (i <= n_shown && shown[i] == "...") i++
  if (j <= n_printed || i <= n_shown) {
    print "not printed: " (farthest <= n_shown ? shown[farthest] : "(the page shows no more lines)") > "/dev/stderr"
    exit 1
  }
  for (i = 1; i <= n_shown; i++) print (shown[i] == "..." ? "..." : shown_now[i])
}
