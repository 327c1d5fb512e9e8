#!/usr/bin/env bash
# The verbs of ./run, in full, that a night runs, as a list in JSON: bash test/turn.sh DAY
# DAY is that of the week, from 1, Monday, to 7; today, by the calendar of Greenwich; or all. The turns are fixed, so that the same
# night runs the same on any machine, and about the same long; ./run windows has a workflow of its own, which runs every night.
set -euo pipefail

turns=(
   ''
   'attack|docs|figures|page'
   'benchmark|city'
   'coverage|demo|experiments --check'
   'intervals|mutations|build pgo'
   'oldest|openquake'
   'reference --quick one_sided two_block free_standing|synthetic44|wheel'
   'stress|verification'
)
case "${1:-}" in
   all) chosen=$(IFS='|' && echo "${turns[*]:1}") ;;
   today) chosen=${turns[$(date -u +%u)]} ;;
   [1-7]) chosen=${turns[$1]} ;;
   *)
      echo "turn: give a day from 1 to 7, today or all" >&2
      exit 2
      ;;
esac
printf '["%s"]\n' "${chosen//|/\",\"}"
