# Steps that take long, for other scripts: . packaging/steps.sh

say() { printf '%s\n' "$*" >&2; }

# step WHAT COMMAND...: say what is done, every ten seconds how far it is, and only if it fails what it printed, and why
step() {
   local what=$1 log beat why status=0
   shift
   log=$(mktemp)
   say "$what"
   signs_of_life "$log" &
   beat=$!
   "$@" >"$log" 2>&1 || status=$?
   { kill "$beat" && wait "$beat"; } 2>/dev/null || true
   if [ $status != 0 ]; then
      tail -n 30 "$log" >&2
      why=$(grep -m 1 -iE '(^|[[:space:]])(fatal )?error: |^E: |undefined reference' "$log" || tail -n 1 "$log")
      say "failed: $what: ${why:0:300}"
   fi
   rm -f "$log"
   return $status
}

# signs_of_life LOG: the last line of a log every ten seconds, as long as the script runs
signs_of_life() {
   local seconds=0 line
   # Not sleep, which would outlive this loop and keep the output open
   while ! read -rt 10 <> <(:) && kill -0 $$ 2>/dev/null; do
      seconds=$((seconds + 10))
      line=$(tail -n 20 "$1" | tr '\r\t' '\n ' | awk 'NF { line = $0 } END { print line }')
      say "   $seconds s: ${line:0:110}"
   done
}
