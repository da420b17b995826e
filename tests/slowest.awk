# Passes ctest's output on as it comes and puts a table of the slowest tests before its summary:
#   ctest ... | awk -f tests/slowest.awk
# The table is left out when no more tests ran than it holds.
BEGIN { most = 20 }

# " 12/900 Test  #12: planning.Planner.EqualsDijkstra ......   Passed    0.05 sec"
/^ *[0-9]+\/[0-9]+ Test +#[0-9]+: .* sec$/ {
  count++
  for (i = 1; i <= NF; ++i)
    if ($i ~ /^#[0-9]+:$/) name[count] = $(i + 1)
  seconds[count] = $(NF - 1)
}

/^[0-9]+% tests passed/ && count > most {
  print "The " most " slowest of " count " tests:"
  for (row = 1; row <= most; ++row) {
    slowest = 0
    for (i = 1; i <= count; ++i)
      if (!(i in told) && (slowest == 0 || seconds[i] + 0 > seconds[slowest] + 0)) slowest = i
    told[slowest] = 1
    printf "%8.2f s  %s\n", seconds[slowest], name[slowest]
  }
  print ""
}

{
  print
  fflush()
}
