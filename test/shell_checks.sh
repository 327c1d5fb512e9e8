# What the tests in shell share: a count of checks that passed and that failed.
passed=0 failed=0

# check WHAT COMMAND...: the command must succeed
check() {
   local what=$1
   shift
   if "$@" >/dev/null 2>&1; then
      passed=$((passed + 1))
   else
      failed=$((failed + 1))
      echo "FAILED  $what"
   fi
}

# The same bytes in two folders or files, but for the names of the runs
same() { diff -r -I '^# run: ' -I '^  "run": ' "$@"; }
