#!/usr/bin/env bash
# The executable as its users meet it: bash test/executable.sh PATH/TO/dondolo
# Ready cases, templates and options must work; every wrong input must give one line, exit code 2 and no file. One that ends in
# .exe is run on Windows as it is and elsewhere by Wine; what only POSIX has is not tried with it: links, pipes, limits of a
# process, /dev and /proc.
set -uo pipefail

if [ $# -ne 1 ] || [ ! -x "$1" ]; then
   echo "usage: executable.sh PATH/TO/dondolo" >&2
   exit 2
fi
exe=$(realpath "$1")
root=$(realpath "$(dirname "${BASH_SOURCE[0]}")/..")
work=$(mktemp -d)
trap 'rm -rf "$work" "$work.exe"' EXIT
cd "$work" || exit 1
windows=
if [[ $exe == *.exe ]]; then
   # Called by a script that takes the CR of its lines away
   windows=$exe exe=$work.exe/dondolo wine=/usr/lib/wine/wine64
   [ -x $wine ] || wine=
   mkdir "$work.exe"
   cat >"$exe" <<SCRIPT
#!/bin/bash
stdout=\$(mktemp) stderr=\$(mktemp)
$wine "$windows" "\$@" >"\$stdout" 2>"\$stderr"
rc=\$?
tr -d '\\r' <"\$stdout"
tr -d '\\r' <"\$stderr" >&2
rm "\$stdout" "\$stderr"
exit \$rc
SCRIPT
   chmod +x "$exe"
fi
on_posix() { [ -z "$windows" ]; }
. "$root/test/shell_checks.sh"

equal() { [ "$1" = "$2" ] || { echo "'$1' should be '$2'"; return 1; }; }
contains() { grep -qF -- "$2" "$1"; }
lacks() { ! contains "$@"; }
# Rows of a result file under its header, and its header
rows() { grep -vc '^#' "$1" | awk '{ print $1 - 1 }'; }
header() { grep -v '^#' "$1" | head -n 1; }
# The files of a folder, and what is in them
listing() { find . -type f -o -type l -o -type d | sort; }

# run ARGUMENTS...: sets rc, output in ../stdout and ../stderr. What costs more than a minute of CPU time is killed.
run() {
   (ulimit -t 60 && exec timeout 300 "$exe" "$@" >"$work/stdout" 2>"$work/stderr" </dev/null)
   rc=$?
}

# Four short records of growing strength, one of them without units and step in the catalogue
records() {
   mkdir -p records
   for i in 1 2 3 4; do
      awk -v n="$i" 'BEGIN { for (k = 0; k < 400; k++) {
         t = 0.01 * k; printf "%.6f\n", (1 + n) * sin(2 * 3.14159265 * (0.5 + 0.3 * n) * t) * exp(-(t - 2) ^ 2) } }' \
         >"records/r$i.txt"
   done
   cat >records/records.csv <<'CSV'
file,dt_s,units,place
r1.txt,0.01,m/s2,here
r2.txt,0.01,m/s2,"here, too"
r3.txt,0.01,m/s2,here
r4.txt,0.01,m/s2,here
CSV
}

# The case that the wrong ones are made of
good_case() {
   cat <<'NML'
! a wall
&job
   task = 'stripes'
   title = 'It''s a wall'
   output = 'out/deep/wall'
   threads = 2
/
&wall
   name = 'wall, one'
   mechanism = 'one_sided'
   height = 3.0
   thickness = 0.25
/
&records
   catalogue = 'records/records.csv'
   polarity = 'both'
/
&stripes
   im = 'pga'
   levels = 0.1, 0.2, 0.4,
            0.6, 1.0
/
&solver
   engine = 'auto'
   rtol = 1.0e-8, atol = 1.0e-10
   edp_limit = 1.0
   gravity = 9.81
/
NML
}

population_case() {
   cat <<'NML'
&job task = 'typology', output = 'out/people' /
&population file = 'walls.csv' /
&records catalogue = 'records/records.csv' /
&stripes levels = 0.1, 0.2, 0.4, 0.8 /
NML
}

population() {
   cat <<'CSV'
name,mechanism,height,thickness,hinge,restitution_factor,weight
a,one_sided,3.0,0.25,,,2
"b ""b""",two_block,3.0,0.25,0.6,0.87,
CSV
}

records

# --- a case of each task -------------------------------------------------------------------------------------------

good_case >good.nml
run good.nml
check "stripes: exit code" equal "$rc" 0
check "stripes: files" equal "$(ls out/deep | tr '\n' ' ')" \
   "wall_fragility.csv wall_histories.csv wall_run.json wall_stripes.csv wall_walls.csv "
check "stripes: header of walls" equal "$(header out/deep/wall_walls.csv)" \
   "wall,mechanism,height_m,thickness_m,density_kg_m3,hinge,restitution_model,restitution_value,restitution_factor,\
overburden_n_m,eccentricity_m,alpha_rad,p_rad_s,trigger_acceleration_m_s2,capacity_rad,restitution,weight,group,p_occ"
check "stripes: header of histories" equal "$(header out/deep/wall_histories.csv)" \
   "wall,mechanism,record,polarity,im,im_level,scale,edp,collapsed,impacts,time_of_peak_s"
check "stripes: header of stripes" equal "$(header out/deep/wall_stripes.csv)" \
   "wall,mechanism,im,im_level,histories,collapses,fraction,edp_threshold"
check "stripes: header of fragility" equal "$(header out/deep/wall_fragility.csv)" \
   "wall,mechanism,im,theta,beta,se_ln_theta,se_beta,log_likelihood,status,bracket_low,bracket_high,edp_threshold,\
theta_low,theta_high,beta_low,beta_high,errors,clusters,degrees_of_freedom,naive_se_ln_theta,naive_se_beta,cov_ln_theta_beta,\
deviance,deviance_dof"
check "stripes: rows of walls" equal "$(rows out/deep/wall_walls.csv)" 1
check "stripes: rows of histories" equal "$(rows out/deep/wall_histories.csv)" 40
check "stripes: rows of stripes" equal "$(rows out/deep/wall_stripes.csv)" 5
check "stripes: rows of fragility" equal "$(rows out/deep/wall_fragility.csv)" 1
check "stripes: a name with a comma is quoted" contains out/deep/wall_walls.csv '"wall, one",one_sided,3.0000000000000000E+00,'
check "stripes: frequency parameter" contains out/deep/wall_walls.csv ',2.210895054992'
check "stripes: version in the head" contains out/deep/wall_walls.csv '# dondolo '
check "stripes: compiler in the head" contains out/deep/wall_walls.csv '# compiler: '
check "stripes: engine in the head" grep -qE '^# engine and build variant: lanes \([a-z0-9]+\)$' out/deep/wall_walls.csv
check "stripes: title in the head" contains out/deep/wall_walls.csv "title = 'It''s a wall'"
check "stripes: levels in the head" contains out/deep/wall_walls.csv 'levels = 0.1, 0.2, 0.4, 0.6, 1'
check "stripes: tolerances in the head" contains out/deep/wall_walls.csv 'rtol = 1e-8, atol = 1e-10'
check "stripes: the file of the run" python3 -c 'import json, zlib
run = json.load(open("out/deep/wall_run.json", encoding="utf-8"))
assert run["format"] == "dondolo run 2" and run["settings"]["job"]["title"] == "It'"'"'s a wall"
assert run["commit"] and run["references"][:2] == ["nale2021", "baker2015"] and "clustered" not in run["references"]
assert run["settings"]["stripes"]["levels"] == [0.1, 0.2, 0.4, 0.6, 1] and run["work"]["histories"] == 40
assert {one["role"] for one in run["inputs"]} == {"case", "catalogue", "record"}
for one in run["inputs"]:
    content = open(one["path"], "rb").read()
    assert (one["bytes"], one["crc32"]) == (len(content), f"{zlib.crc32(content):08x}"), one
for one in run["files"]:
    content = open("out/deep/wall" + one["name"], "rb").read()
    head = "# dondolo {version}\n# run: {run}\n".format(**run).encode()
    assert content.startswith(head), one
    assert (one["bytes"], one["crc32"]) == (len(content), f"{zlib.crc32(content[len(head):]):08x}"), one
assert len(run["files"]) == 4 and run["shape"] == {"walls": 1, "levels": 5, "states": 1, "records": 4}'
check "stripes: collapses of the tables agree" equal \
   "$(grep -v '^#' out/deep/wall_histories.csv | awk -F, 'NR > 1 { s += $(NF - 2) } END { print s }')" \
   "$(grep -v '^#' out/deep/wall_stripes.csv | awk -F, 'NR > 1 { s += $(NF - 2) } END { print s }')"
check "stripes: a collapsed history has the limit as EDP" equal \
   "$(grep -v '^#' out/deep/wall_histories.csv | awk -F, '$(NF - 2) == 1 && $(NF - 3) != 1 { n++ } END { print n + 0 }')" 0
check "stripes: some history collapses, some survives" test \
   "$(grep -v '^#' out/deep/wall_histories.csv | awk -F, '$(NF - 2) == 1' | wc -l)" -gt 0
check "stripes: both polarities" equal "$(grep -c ',reversed,' out/deep/wall_histories.csv)" 20
check "stripes: nothing left half written" equal "$(find . -name '*.part')" ""
check "stripes: summary names a file" contains stdout 'written: out/deep/wall_fragility.csv'
check "stripes: summary has the median between the levels at 16 and 84 %" equal \
   "$(sed -n 's/^pga at a probability of 16, 50, 84 %: [0-9.]*, \(.*\), [0-9.]* g$/\1/p' stdout)" \
   "$(sed -n 's/^theta = \([0-9.]*\) g, .*/\1/p' stdout)"
check "stripes: summary says what the standard errors assume" grep -qE \
   '^\(4 clusters of records, 3 degrees of freedom; naive standard errors, as if all histories were independent: ' stdout
check "stripes: the file of the run has the clusters" python3 -c 'import json
run = json.load(open("out/deep/wall_run.json", encoding="utf-8"))
assert run["standard_errors"]["clusters"] == len(run["records"]) == 4, run["records"]
assert len({one["checksum"] for one in run["records"]}) == 4'
check "stripes: summary says where the records are applied" grep -q \
   '^note: records are applied at the base of the wall; ground records underestimate the demand on parapets, gables' stdout
check "stripes: summary names the engine" grep -qE ' threads, engine lanes \([a-z0-9]+\)$' stdout
check "stripes: no escape sequence where there is no terminal" lacks stderr $'\033'
run --quiet good.nml
check "quiet: exit code" equal "$rc" 0
check "quiet: no output" equal "$(cat stdout)" ""

sed '/threads/d' good.nml >free.nml
OMP_NUM_THREADS=1 timeout 300 "$exe" free.nml >stdout 2>stderr
check "OMP_NUM_THREADS is honoured" contains stdout 'a second on 1 thread'
run good.nml
check "threads of the case" contains stdout 'a second on 2 threads'
run good.nml --threads 1
check "threads of the command line" contains stdout 'a second on 1 thread'
if on_posix; then
   # Libraries of OpenMP print what holds when they begin, the last time for the program that computes.
   policy() { (export OMP_DISPLAY_ENV=true; run --check good.nml; grep WAIT_POLICY stderr | tail -n 1 | grep -oiE 'active|passive'); }
   check "threads: sleep while they wait" equal "$(OMP_NUM_THREADS=2 policy)" PASSIVE
   check "threads: do what the user wants" equal "$(OMP_NUM_THREADS=2 OMP_WAIT_POLICY=active policy)" ACTIVE
fi
mkdir one two
(cd one && ln -s ../records . && cp ../good.nml . && "$exe" --quiet --threads 1 good.nml) 2>/dev/null
(cd two && ln -s ../records . && cp ../good.nml . && "$exe" --quiet --threads=2 good.nml) 2>/dev/null
check "same bytes from one thread and two" same one two
check "same bytes from one thread and two: there are files" test -s one/out/deep/wall_histories.csv
rm -rf one two out

# What was computed: exact where it can be known, the same for any number of threads
sed 's/levels = 0.1, 0.2, 0.4/levels = 0.08, 0.085, 0.4/' good.nml >calm.nml
run calm.nml
check "work: summary of still ones" grep -qE '^never moved: [0-9.]+ %, [0-9]+ of 40 histories; rocking: ' stdout
check "work: steps are in the files only" lacks stdout ' steps, '
check "work: in the head of every file" equal "$(grep -lE '^# work: histories = 40, still = [0-9]+, intervals = 15960, ' out/deep/*.csv | wc -l)" 4
still=$(sed -n 's/^# work: .*still = \([0-9]*\),.*/\1/p' out/deep/wall_walls.csv)
check "work: still ones are those without an EDP" equal "$still" \
   "$(grep -v '^#' out/deep/wall_histories.csv | awk -F, 'NR > 1 && $(NF - 3) == 0 { n++ } END { print n + 0 }')"
check "work: some are still, some are not" test "$still" -gt 0 -a "$still" -lt 40
run --check calm.nml
check "work: --check knows what stays still" contains stdout \
   "of them $still stay below the trigger and never move; $((40 - still)) will be integrated"
check "check: records that name no event" contains stdout \
   '4 records in 4 clusters; 4 without event, or station and date, taken as independent of all others but copies'
check "check: they are warned of once" equal "$(grep -c '^warning: no event is given for 4 of 4 records' stdout)" 1
sed 's/place$/event/' records/records.csv >records/events.csv
sed 's/records.csv/events.csv/' calm.nml >events.nml
run --check events.nml
check "check: records of two events" contains stdout '4 records in 2 clusters by event, or by station and date'
check "check: nothing to warn of" equal "$(grep -c 'no event is given' stdout)" 0
for case in good events; do
   run $case.nml
   check "records that name no event, $case: one warning" equal "$(grep -c '^dondolo: warning: no event is given for' stderr)" \
      "$([ $case = good ] && echo 1 || echo 0)"
done
sed "s/levels = .*/levels = 0.01, 0.02/; /0.6, 1.0/d" good.nml >calm.nml
run --quiet calm.nml
check "work: none below the trigger" contains out/deep/wall_walls.csv \
   '# work: histories = 16, still = 16, intervals = 6384, rocked = 0, steps = 0, evaluations = 0, impacts = 0'
rm -rf out

sed "s/height = .*/height = 300.0/" good.nml >tall.nml
run --check --quiet tall.nml
check "check, quiet: nothing but warnings" equal "$rc $(cat stdout)" "0 "
check "check, quiet: the warning" contains stderr "dondolo: warning: wall 'wall, one': height = 300 m is more than 60 m"

# What a strip leaves out, and a floor that the ground governs
sed "s/'one_sided'/'two_block', overburden = 15e3, overburden_inertia = 0/; s/thickness = 0.25/thickness = 0.20/" good.nml >strip.nml
cat >>strip.nml <<'NML'
&building period = 0.3, storeys = 3, level = 0.0, building_height = 9.6 /
&check ag = 0.2, f0 = 2.5, tc_star = 0.35, soil = 'B', knowledge_factor = 1.2 /
NML
run strip.nml
check "a strip that bends: the warning" contains stderr 'and medians are 6 to 22 % lower at a period of 0.10 s'
check "a strip that bends: in the file of the run" contains out/deep/wall_run.json '"bending_neglected"'
check "a strip near the ground: the ground governs" contains stdout 'note: the modes of the building give a_Z = '
check "a strip near the ground: by analogy" contains stdout 'by analogy with [C7.2.11]'
check "a strip near the ground: both numbers" contains out/deep/wall_check.csv 'modal_pga'
rm -rf out

sed -e "s/levels = .*/first = 0.4, last = 1.0, count = 4/; /0.6, 1.0/d" good.nml >grid.nml
run grid.nml
check "grid of levels" contains out/deep/wall_stripes.csv 'levels = 0.4, 0.6, 0.8, 1'
rm -rf out

# Every intensity measure, with its unit in the files and in the summary
for pair in pga:g 'sa(0.5):g' 'saavg(0.2,2):g' pgv:m/s arias:m/s cav:m/s pgd:m hi:m pga/a0:1 'p*pgv/a0:1'; do
   im=${pair%:*} unit=${pair##*:}
   im=${im/,/:}
   sed "s|'pga'|'$im'|; s/'both'/'reversed'/" good.nml >im.nml
   run im.nml
   check "$im: exit code" equal "$rc" 0
   check "$im: name in the rows" equal "$(grep -v '^#' out/deep/wall_stripes.csv | awk -F, 'NR == 2 { print $4 }')" "$im"
   check "$im: unit in the head" contains out/deep/wall_fragility.csv "# unit of im_level and theta: $unit"
   [ "$unit" = 1 ] || check "$im: unit in the summary" contains stdout " $im $unit "
   run --check im.nml
   [ "$im" = arias ] && check "$im: intensity of the records in the plan" test \
      "$(grep -cE '^  no\.  record .* PGV +arias' stdout)" = 1
   check "$im: unit in the plan" contains stdout "5 levels of $im: 0.1 0.2 0.4 0.6 1"
   rm -rf out
done
{ good_case | sed "s/'stripes'/'history'/; s/'both'/'reversed'/; s/'pga'/'arias'/"; echo "&history record = 3, im_level = 0.4 /"; } \
   >arias.nml
run arias.nml
check "Arias intensity of the history" equal \
   "$(grep -v '^#' out/deep/wall_history.csv | awk -F, 'NR > 1 && $1 <= 3.9900001 { s += (($1 - t) * (a * a + a * $2 + $2 * $2)) / 3; t = $1; a = $2 }
      END { printf "%.4f", s * 3.14159265 / 2 / 9.81 }')" 0.4000
rm -rf out
population_case | sed "s|levels = .*|im = 'pga/a0', levels = 1.2, 2, 4, 8 /|" >people.nml
population >walls.csv
run people.nml
check "population by pga/a0: exit code" equal "$rc" 0
check "population by pga/a0: summary" contains stdout '      pga/a0  mean fraction'
rm -rf out

population_case >people.nml
population >walls.csv
run people.nml
check "typology: exit code" equal "$rc" 0
check "typology: files" equal "$(ls out | tr '\n' ' ')" \
   "people_fragility.csv people_run.json people_stripes.csv people_typology.csv people_walls.csv "
check "typology: header" equal "$(header out/people_typology.csv)" \
   "mechanism,im,im_level,weight,mean_fraction,mean_curve,theta,beta,status,group,fractile_16,fractile_50,fractile_84,beta_walls,beta_records,upper_asymptote,edp_threshold,\
se_ln_theta,se_beta,cov_ln_theta_beta,errors,clusters,degrees_of_freedom"
check "typology: rows" equal "$(rows out/people_typology.csv)" 12
check "typology: rows of stripes" equal "$(rows out/people_stripes.csv)" 8
check "typology: levels at 16, 50, 84 % of each curve" equal \
   "$(grep -cE '^population, .* status [a-z]+; at 16, 50, 84 %: [0-9.]+, [0-9.]+, [0-9.]+ g$' stdout)" \
   "$(grep -c '^population, .*: theta = ' stdout)"
check "typology: summary says where the records are applied" contains stdout 'note: records are applied at the base of the wall; '
check "typology: quotes in a name" contains out/people_walls.csv '"b ""b""",two_block,'
check "typology: weights" equal "$(grep -v '^#' out/people_typology.csv | awk -F, 'NR % 4 == 2 { print $4 + 0 }' | tr '\n' ' ')" "2 1 3 "
check "typology: mechanisms" equal "$(grep -v '^#' out/people_typology.csv | awk -F, 'NR % 4 == 2 { print $1 }' | tr '\n' ' ')" \
   "one_sided two_block all "
check "typology: mean fraction" equal \
   "$(grep '^all,' out/people_typology.csv | awk -F, '{ printf "%.9f ", $5 }')" \
   "$(grep -v '^#' out/people_stripes.csv | awk -F, 'NR > 1 { k = (NR - 2) % 4; w = NR < 6 ? 2 : 1; s[k] += w * $(NF - 1) / 3 }
      END { for (k = 0; k < 4; k++) printf "%.9f ", s[k] }')"
population | sed '1s/$/,x_address,Note/; 2s/$/,"via Roma 3, 2",=1/; 3s/$/,,1.10/' >walls.csv
run people.nml
check "notes: kept at the end of the walls" equal "$(grep -v '^#' out/people_walls.csv | sed -E '1s/.*,(x_)/\1/; 2,$s/^[^,"]*,.*E[+-][0-9]+,//; 3s/^.*E[+-][0-9]+,//' | tr '\n' '|')" \
   'x_address,Note|"via Roma 3, 2",=1|,1.10|'
population >walls.csv
rm -rf out
{ population_case; echo "&check ag = 0.2, f0 = 2.5, tc_star = 0.35, soil = 'B' /"; } >checked.nml
run checked.nml
check "checks of a population: rows" equal "$(rows out/people_checks.csv)" 2
check "checks of a population: a_g S that a wall stands, nonlinear, SLV" equal \
   "$(grep '^a,' out/people_checks.csv | awk -F, '{ printf "%.10f", $11 / 1.2 }')" 0.0820616990
# 2 t/(H r) at the weakest hinge, which is the highest of the range: r = 0.9
check "checks of a population: alpha_0 of a strip" equal \
   "$(grep '^"b ' out/people_checks.csv | awk -F, '{ printf "%.10f", $4 }')" 0.1851851852
check "checks of a population: summary" contains stdout 'C8.7.1.2.1, of 2 rows'
check "checks of a population: verdicts" grep -qE '^nonlinear +SLV +0\.24 +0 +0\.4103$' stdout
rm -rf out
{ population_case; echo "&check ag = 0.2, f0 = 2.5, tc_star = 0.35, soil = 'B' /"; } >checked.nml
population | sed '1s/$/,period1,damping1,participation1/; 2s/$/,0.3,0,1.2/; 3s/$/,,,/' >walls.csv
run checked.nml
check "checks of a population: why there is none" contains out/people_checks.csv 'damping = 0: must be positive for the spectrum of a floor'
check "checks of a population: those left out" contains stdout 'not checked: 1 row'
population >walls.csv
rm checked.nml
rm -rf out
population | sed '1s/$/,p_occ/; 2s/$/,0.4/; 3s/$/,0/' >walls.csv
run people.nml
check "typology: no level where so many cannot collapse" grep -qE \
   '^population, all \(can occur: .* status [a-z]+; at 16, 50, 84 %: [0-9.]+ g, never, never$' stdout
printf 'mechanism,height,thickness,overburden,overburden_inertia,bearing,bearing_distance,eccentricity\n%s\n%s\n' \
   'two_block,3,0.25,8000,0,inner,0.06,' 'two_block,3,0.25,8000,0,,,-0.065' >walls.csv
run people.nml
check "typology: a bearing is an eccentricity" equal \
   "$(grep '^wall 1,' out/people_stripes.csv | cut -d, -f 2-)" "$(grep '^wall 2,' out/people_stripes.csv | cut -d, -f 2-)"
check "typology: a bearing is an eccentricity: there are rows" equal "$(grep -c '^wall 1,' out/people_stripes.csv)" 4
rm -rf out
population >walls.csv
for threads in 1 2 3; do
   run --quiet --threads $threads people.nml
   mv out people$threads
done
check "typology: same bytes from walls one after the other and side by side" same people1 people2
check "typology: same bytes from more threads than walls" same people1 people3
rm -rf people[123]

{ good_case | sed "s/'stripes'/'history'/; s/'both'/'reversed'/"; echo "&history record = 'r3', im_level = 0.15 /"; } >history.nml
run history.nml
check "history: exit code" equal "$rc" 0
check "history: files" equal "$(ls out/deep | tr '\n' ' ')" "wall_history.csv wall_run.json wall_walls.csv "
check "history: header" equal "$(header out/deep/wall_history.csv)" \
   "time_s,ground_acceleration_m_s2,rotation_rad,velocity_rad_s,edp,side,after_impact"
check "history: marks of impacts" equal \
   "$(awk -F, '!/^#/ && $1 <= 3.9900001 { n += $7 } END { print n + 0 }' out/deep/wall_history.csv)" \
   "$(sed -n 's/^# impacts: //p' out/deep/wall_history.csv)"
check "history: rows" test "$(rows out/deep/wall_history.csv)" -gt 400
check "history: scaled to the level" equal \
   "$(grep -v '^#' out/deep/wall_history.csv | awk -F, 'NR > 1 { a = $2 < 0 ? -$2 : $2; if (a > m) m = a } END { printf "%.6f", m }')" 1.471500
check "history: reversed" equal \
   "$(grep -v '^#' out/deep/wall_history.csv | awk -F, 'NR == 150 { print ($2 < 0) }')" \
   "$(awk 'NR == 149 { print ($1 > 0) }' records/r3.txt)"
sed "s/record = 'r3', im_level = 0.15/record = 3, scale = 1/" history.nml >history2.nml
run history2.nml
check "history by number: exit code" equal "$rc" 0
run history.nml
cp out/deep/wall_history.csv plain.csv
sed 's/edp_limit = 1.0/estimate_error = .true./' history.nml >estimate.nml
run estimate.nml
check "estimated error: printed" contains "$work/stdout" "estimated error of the EDP: "
check "estimated error: in the head" equal "$(grep -c '^# edp_error: ' out/deep/wall_history.csv)" 1
check "estimated error: the same motion" diff <(grep -v '^#' plain.csv) <(grep -v '^#' out/deep/wall_history.csv)
good_case >plain.nml
run plain.nml
cp out/deep/wall_histories.csv plain.csv
good_case | sed 's/edp_limit = 1.0/estimate_error = .true./' >estimate.nml
run estimate.nml
check "estimated errors: printed" contains "$work/stdout" "estimated errors of the EDP: at most "
check "estimated errors: everything runs three times" contains out/deep/wall_histories.csv '# work: histories = 120, '
check "estimated errors: the summary says so" contains "$work/stdout" 'every history was run twice more'
check "estimated errors: a column" equal "$(header out/deep/wall_histories.csv | awk -F, '{ print $NF }')" edp_error
check "estimated errors: all else the same" diff <(grep -v '^#' plain.csv) \
   <(grep -v '^#' out/deep/wall_histories.csv | sed 's/,[^,]*$//')
sed "s/'history'/'stripes'/" history.nml >both.nml
run both.nml
check "history group in a stripes case" equal "$rc" 0
run history.nml
check "results of another task are not left" equal "$(ls out/deep | tr '\n' ' ')" "wall_history.csv wall_run.json wall_walls.csv "
echo 'my own notes' >out/deep/wall_stripes.csv
cp history.nml out/deep/wall_typology.csv
run history.nml
check "a file that is no result is left" equal "$(ls out/deep | tr '\n' ' ')" \
   "wall_history.csv wall_run.json wall_stripes.csv wall_typology.csv wall_walls.csv "
run --check both.nml
check "--check removes nothing" equal "$(ls out/deep | tr '\n' ' ')" \
   "wall_history.csv wall_run.json wall_stripes.csv wall_typology.csv wall_walls.csv "
rm -rf out

printf '\xef\xbb\xbf%s' "$(sed 's/$/\r/' good.nml)" >dos.nml
run dos.nml
check "CRLF and byte order mark" equal "$rc" 0
printf "&JOB OUTPUT='o' &END\n&Wall MECHANISM=\"one_sided\" Height=3 thickness=2.5d-1/\n&records catalogue='records/records.csv'/ &stripes levels=.2 .4 .8 /" >terse.nml
run terse.nml
check "capitals, &end, blanks between values, no line end" equal "$rc" 0
rm -f o_*

# --- ready cases and templates -------------------------------------------------------------------------------------

for case in "$root"/data/cases/*.nml; do
   run "$case"
   check "$(basename "$case"): exit code" equal "$rc" 0
   name=$(basename "$case" .nml)
   check "$name: walls" test -s "out/${name}_walls.csv"
done
rm -rf out
mkdir template
ln -s "$root/data" template/data
cd template || exit 1
for task in stripes history typology; do
   run --template $task
   cp ../stdout "$task.nml"
   check "template $task: has its task" contains "$task.nml" "task = '$task'"
   run "$task.nml"
   check "template $task: runs as it is" equal "$rc" 0
   check "template $task: results" test -s "out/${task}_walls.csv"
done
run --template
check "template without a task" diff ../stdout stripes.nml
cat ./*.nml >all
for variable in task title output threads name mechanism height thickness density hinge restitution \
   restitution_value restitution_factor overburden overburden_inertia bearing bearing_distance eccentricity file catalogue polarity im levels first last count \
   engine rtol atol edp_limit estimate_error gravity record scale im_level code ag f0 tc_star latitude longitude nominal_life use_class soil topography knowledge_factor behaviour ultimate_state friction; do
   check "template: $variable" grep -qE "(^|[ ,])$variable = " all
done
# Every default that a template shows is the one in force: a case that leaves it out has the same echo
sed -E '/^ *(title|threads|name|density|restitution|restitution_factor|polarity|im|engine|rtol|atol|edp_limit|estimate_error|gravity|code|use_class|soil|topography|knowledge_factor|behaviour|ultimate_state) = /d' \
   stripes.nml >short.nml
run --quiet stripes.nml
cp out/stripes_fragility.csv long.csv
run --quiet short.nml
check "template: defaults are the ones in force" same out/stripes_fragility.csv long.csv
sed -E "/^ *(record|scale) = /d" history.nml >short.nml
run --quiet history.nml
cp out/history_history.csv long.csv
check "history: the engine that ran" grep -qE '"engine": "lanes \([a-z0-9]+\)"' out/history_run.json
run --quiet short.nml
check "template: defaults of history" same out/history_history.csv long.csv
sed "s/engine = 'auto'/engine = 'rk45'/" history.nml >slow.nml
run --quiet slow.nml
check "history: the engine that was asked for" contains out/history_run.json '"engine": "rk45 (baseline)"'
cd "$work" || exit 1
rm -rf template

mkdir example
cd example || exit 1
for case in "$root"/data/cases/*.nml; do
   name=$(basename "$case" .nml)
   run --example "$name"
   check "example $name: exit code" equal "$rc" 0
   check "example $name: paths are absolute" lacks ../stdout "'../"
   cp ../stdout "$name.nml"
   run --check --quiet "$name.nml"
   check "example $name: finds its files anywhere" equal "$rc" 0
done
run --example parapet
cp ../stdout parapet.nml
run run --quiet parapet.nml
check "run CASE: as CASE" test "$rc" = 0 -a -s out/parapet_fragility.csv
cd "$work" || exit 1
rm -rf example

# --- options -------------------------------------------------------------------------------------------------------

run --help
check "help: exit code" equal "$rc" 0
for option in --check --walls --merge --status --template --example --benchmark --completion --cite --threads --quiet --version --verbose --help; do
   check "help: $option" contains stdout "$option"
   check "unknown option: $option is offered" grep -q -- " $option" <("$exe" --fast 2>&1)
done
for shell in bash zsh; do
   run --completion $shell
   check "completion $shell: exit code" equal "$rc" 0
   check "completion $shell: ends as it should" equal "$(tail -n 1 stdout)" 'complete -o filenames -F _dondolo dondolo'
done
# complete_word WORD...: what bash offers for the last word of a command line
complete_word() {
   bash -c '. <("$1" --completion bash); shift; COMP_WORDS=(dondolo "$@"); COMP_CWORD=$#; _dondolo; echo "${COMPREPLY[*]}"' - "$exe" "$@"
}
check "completion: options" equal "$(complete_word --ex)" --example
check "completion: commands" equal "$(complete_word re)" 'report relazione records'
check "completion: examples" equal "$(complete_word --example pin)" pinnacle
# Commands that Python carries out, and the line where there is no Python with the package
mkdir alone
cp "${windows:-$exe}" alone/dondolo
for command in plot report relazione xlsx nrml openquake diff records catalogue; do
   check "$command: in the help" grep -q "^   dondolo $command " <("$exe" --help)
   if on_posix; then
      said=$(PATH=/nowhere alone/dondolo $command nothing 2>&1)
   else
      said=$("$exe" $command nothing 2>&1)
   fi
   check "$command without Python: exit code" equal $? 1
   check "$command without Python: one line" contains <(echo "$said") "dondolo: $command needs the Python package dondolo"
   if [ -x "$(dirname "$exe")/python3" ]; then
      run $command
      check "$command: Python answers" contains stderr "dondolo $command"
   fi
done
rm -rf alone
before=$(listing)
run --benchmark 0.01 --threads 2
check "benchmark: exit code" equal "$rc" 0
check "benchmark: writes nothing" equal "$(listing)" "$before"
for what in 'processor: ' 'machine: ' 'compiler: GCC' 'options: -' 'engine: lanes (' 'figure of merit: ' 'arithmetic of the steps: '; do
   check "benchmark: $what" grep -q "^$what" stdout
done
check "benchmark: one and two threads" equal "$(awk 'NF == 7 && $1 ~ /^[0-9]+$/ && $2 > 0 { printf "%s ", $1 }' stdout)" "1 2 "
check "benchmark: collapses of each mechanism" equal \
   "$(awk '/ collapses in 1320 histories$/ { printf "%s%d ", $1, ($2 > 0 && $2 < 1320) }' stdout)" \
   "one_sided:1 free_standing:1 two_block:1 "
# Three columns of numbers; the rates lie within a factor of ten of each other, and so do the mechanisms' and that of all.
check "benchmark: operations a second of each mechanism" equal \
   "$(awk '/^arithmetic of the steps/ { all = $5 / 1e9 }
      NF == 4 && $1 ~ /^(one_sided|free_standing|two_block)$/ {
         printf "%s:%d ", $1, ($2 > 0 && $3 > 0.1*all && $3 < 10*all && $4 > 0) }' stdout)" \
   "one_sided:1 free_standing:1 two_block:1 "
sed -n '/^fingerprint/,$p' stdout >fingerprint
run --benchmark=0.001 --threads=1
check "benchmark: the same results from one thread" diff fingerprint <(sed -n '/^fingerprint/,$p' stdout)
check "benchmark: one thread only" equal "$(awk 'NF == 7 && $1 ~ /^[0-9]+$/' stdout | wc -l)" 1
run --quiet --benchmark 0.001 --threads 1
check "benchmark: quiet" equal "$(cut -d: -f1 stdout)" "figure of merit"
run --version
check "version: exit code" equal "$rc" 0
check "version: as in fpm.toml" equal "$(head -n 1 stdout)" "dondolo $(sed -n 's/^version = "\(.*\)"/\1/p' "$root/fpm.toml")"
check "version: nothing more" equal "$(wc -l <stdout)" 2
run --version --verbose
for line in commit compiler options reals LAPACK processor machine; do
   check "version: verbose: $line" grep -qE "^$line: .*[[:alnum:]]" stdout
done
check "version: names the build variant" grep -qE '^build variant (baseline|native|avx2|avx512)$' stdout
before=$(listing)
run good.nml --check
check "check: exit code" equal "$rc" 0
check "check: writes nothing" equal "$(listing)" "$before"
check "check: wall" contains stdout 'one_sided'
check "check: records" contains stdout 'r4'
check "check: peak velocity" contains stdout 'PGV'
check "check: problems" contains stdout 'problems'
check "check: histories" contains stdout '40 histories'
check "check: scale" contains stdout 'largest scale factor'
run --check history.nml
check "check: history" contains stdout "one history: record 'r3'"
run --check people.nml
check "check: population" contains stdout '32 histories'
run people.nml
bodies() { cat out/people_*.csv | grep -v '^#'; }
bodies >as_given
{ echo 'Survey, 2024;;;;;;;'; population | tr , ';' | sed -E 's/([0-9])\.([0-9])/\1,\2/g; s/$/;/'; echo ';;;;;;;'; } >walls.csv
sed "s/'typology'/'TYPOLOGY'/; s/&stripes/\&stripes im = 'PGA'/; s/file/FILE/" people.nml >upper.nml
run upper.nml
note='walls.csv: read with columns separated by semicolons, decimal commas, line 1 is a title'
check "a table of a spreadsheet: note" equal "$(head -n 1 stderr)" "dondolo: note: $note"
check "a table of a spreadsheet: the same results" equal "$(bodies)" "$(cat as_given)"
check "a table of a spreadsheet: note in the head" contains out/people_typology.csv "# note: $note"
run --check upper.nml
check "a table of a spreadsheet: note on --check" equal "$(cat stderr)" "dondolo: note: $note"
population >walls.csv
rm upper.nml as_given out/people_*

# refused WHAT PART ARGUMENTS...: exit code 2, one line with a part, no output, no file
refused() {
   local what=$1 part=$2 before
   shift 2
   before=$(listing)
   run "$@"
   check "$what: exit code $rc" equal "$rc" 2
   check "$what: one line: $(cat stderr)" equal "$(wc -l <stderr)" 1
   check "$what: begins with the program" grep -q '^dondolo: ' stderr
   check "$what: says '$part', not: $(cat stderr)" contains stderr "$part"
   check "$what: no output" equal "$(cat stdout)" ""
   check "$what: no file" equal "$(listing)" "$before"
}

refused "no argument" 'no case given: dondolo CASE.nml'
refused "unknown option" '--fast: no such option; there are --check' --fast good.nml
refused "unknown short option" '-q: no such option' -q good.nml
refused "misspelt command" "plto: no such file or command; did you mean 'plot'?" plto out/wall
refused "two cases" 'people.nml: one case at a time, good.nml was given before' good.nml people.nml
refused "threads without a number" '--threads: a number must follow' good.nml --threads
refused "threads with a word" '--threads many: must be an integer between 0 (all) and 1024' --threads many good.nml
refused "negative threads" '--threads -1: must be an integer' --threads -1 good.nml
refused "empty threads" '--threads : must be an integer' --threads= good.nml
refused "template of a task that does not exist" "--template walls: the task must be one of 'history'" --template walls
refused "a verbose run" '--verbose: goes with --version alone' --verbose good.nml
refused "two actions" '--version: cannot go together with --check' --check --version
refused "example that does not exist" "--example barn: must be one of 'arch', 'cavity_wall', 'compound', 'corner', 'designs'" --example barn
refused "example without a name" "--example: must be one of 'arch', 'cavity_wall', 'compound', 'corner', 'designs'" --example
refused "example with a case" '--example takes no case' good.nml --example parapet
refused "completion of an unknown shell" "--completion fish: must be one of 'bash', 'zsh'" --completion fish
refused "run without a case" 'no case given' run
refused "template with a case" '--template takes no case' good.nml --template
refused "benchmark with a case" '--benchmark takes no case' good.nml --benchmark
refused "benchmark of no length" '--benchmark 0: must be a length of a measurement between 0.001 and 60 s' --benchmark 0
refused "benchmark of a case" '--benchmark good.nml: must be a length' --benchmark good.nml
refused "benchmark without its length" '--benchmark : must be a length' --benchmark=
refused "no such case" 'none.nml: no such file' none.nml
refused "a folder for a case" 'records: is a folder, must be a namelist file' ./records
: >empty.nml
refused "empty file" 'empty.nml: the file is empty' empty.nml
echo '! nothing' >comment.nml
refused "only a comment" 'comment.nml: no group' comment.nml
{ printf '&job '; head -c 1048576 /dev/zero | tr '\0' ','; echo /; } >long.nml
refused "a case of 1 MB" 'long.nml: has 1048583 bytes: must be at most 1048576' long.nml
rm long.nml
head -c 3000 /dev/urandom >noise.nml
check "noise: exit code" equal "$(run noise.nml; echo $rc)" 2
refused "an accelerogram for a case" 'is outside a group: must be &name ... /' records/r1.txt

# --- wrong cases: what is changed (sed), what must be said ---------------------------------------------------------

touch bad.nml
DONDOLO_VARIANT=bogus refused "a build variant that there is not" "DONDOLO_VARIANT = 'bogus': this build and this processor have '" \
   good.nml
DONDOLO_VARIANT=bogus refused "its name" "DONDOLO_VARIANT = 'bogus': this build and this processor have '" --version
bad() {
   good_case | sed -E -e "$1" >bad.nml
   refused "$1" "$2" bad.nml
   # A group that is not there is in no line.
   if grep -qi "^$(grep -oE '&[a-z]+' stderr | head -n 1)" bad.nml && grep -q '^dondolo: bad.nml: ' stderr; then
      check "$1: names a line, not: $(cat stderr)" grep -qE 'lines? [0-9]+' stderr
   fi
}
while IFS='|' read -r change part; do
   # Windows knows backslashes, and no /proc
   if ! on_posix && [[ $part == *records\\records.csv* || $part == */proc/* ]]; then continue; fi
   [ -n "$change" ] && bad "$change" "$part"
done <<'TABLE'
s/^&wall/\&walls/|bad.nml: &walls (line 8): no such group; there are &job, &wall, &building, &population
s/^&solver/\&wall/|bad.nml: &wall: given twice, in lines 8 and 23
s/height/heigth/|bad.nml: &wall: heigth (line 11): no such variable; did you mean 'height'? dondolo --template lists all
s/task/tasks/|bad.nml: &job: tasks (line 3): no such variable; there are 'task', 'title', 'output', 'histories', 'spreadsheet_safe', 'threads'; did you mean 'task'?
s/engine/motor/|bad.nml: &solver: motor (line 24): no such variable; there are 'engine', 'rtol'
s/polarity/sign/|bad.nml: &records: sign (line 16): no such variable; there are 'catalogue', 'polarity'
s/im =/measure =/|bad.nml: &stripes: measure (line 19): no such variable; there are 'im', 'levels', 'first'
s/thickness = 0.25/thickness = 0.25 height = 2/|bad.nml: &wall: height: given twice, in lines 11 and 12
s/height = 3.0/height = 3,0/|bad.nml: &wall: height = 3,0: must be one number; a decimal point is needed: 3.0 (line 11)
s/height = 3.0/height = 3.0 4.0/|bad.nml: &wall: height = 3.0, 4.0: must be one value, not 2
s/height = 3.0/height = '3.0'/|bad.nml: &wall: height = '3.0': must be a number without quotes
s/height = 3.0/height = tall/|bad.nml: &wall: height = tall: must be a number, such as 0.25
s/height = 3.0/height = 3m/|bad.nml: &wall: height = 3m: must be a number
s/height = 3.0/height = nan/|bad.nml: &wall: height = nan: must be a number
s/height = 3.0/height = inf/|bad.nml: &wall: height = inf: must be a number
s/height = 3.0/height = +Infinity/|bad.nml: &wall: height = +Infinity: must be a number
s/height = 3.0/height = 1e400/|bad.nml: &wall: height = 1e400: must be a number that the computer can hold
s/height = 3.0/height = 1e4/|bad.nml: &wall: height = 10000: must lie between 0.001 and 1000
s/height = 3.0/height = -3.0/|bad.nml: &wall: height = -3: must be positive
s/height = 3.0/height = 0/|bad.nml: &wall: height = 0: must be positive
s/height = 3.0/height =/|bad.nml: &wall: height (line 11): no value follows its =
s/height = 3.0/height = ,/|bad.nml: &wall: height (line 11): a value is missing before a comma
s/height = 3.0/height 3.0/|bad.nml: &wall: mechanism = 'one_sided', height, 3.0: must be one value, not 3; is an = missing in line 11?
s/height = 3.0/height == 3.0/|bad.nml: &wall: height (line 11): a second = follows it
s/height = 3.0/height = 1*3.0/|bad.nml: &wall: height (line 11): 1*3.0: repeat counts are not allowed
s/height = 3.0/height(1) = 3.0/|bad.nml: &wall: height(1) (line 11): subscripts are not allowed
s/height = 3.0/= 3.0/|bad.nml: &wall: mechanism (line 10): a second = follows it
s/^.*height = 3.0//|bad.nml: &wall: height: must be given
s/^.*thickness = .*//|bad.nml: &wall: thickness: must be given
s/^.*mechanism = .*//|bad.nml: &wall: mechanism: must be given, one of 'one_sided', 'free_standing', 'two_block'
s/one_sided/two_sided/|bad.nml: &wall: mechanism = 'two_sided': must be one of 'one_sided', 'free_standing', 'two_block'
s/'one_sided'/one_sided/|bad.nml: &wall: mechanism = one_sided: must be text in quotes, such as 'one_sided'
s/'one_sided'/1/|bad.nml: &wall: mechanism = 1: must be text in quotes
s/thickness = 0.25/thickness = -0.25/|bad.nml: &wall: thickness = -0.25: must be positive
s/thickness = 0.25/thickness = 0.25 density = 0/|bad.nml: &wall: density = 0: must be positive
s/thickness = 0.25/thickness = 0.25 hinge = 0.5/|bad.nml: &wall: hinge = 0.5: only for mechanism = 'two_block'
s/thickness = 0.25/thickness = 0.25 overburden = 10/|bad.nml: &wall: overburden = 10: only for mechanism = 'two_block'
s/thickness = 0.25/thickness = 0.25 eccentricity = 0.1/|bad.nml: &wall: eccentricity = 0.1: only for mechanism
s/thickness = 0.25/thickness = 0.25 leaves = 2 tie_height = 2.5 tie_area = 5e-5 tie_length = 8/|bad.nml: &wall: tie_height: not with leaves = 2, it acts on one leaf; describe each leaf as a wall of its own thickness
s/thickness = 0.25/thickness = 0.25 leaves = 2 mass = 900 centroid_depth = 0.1 centroid_height = 1.5 hinge_inertia = 3000/|bad.nml: &wall: mass = 900: not with leaves = 2
s/thickness = 0.25/thickness = 0.25 hinge_depth = 0.01 compressive_strength = 2e6/|bad.nml: &wall: hinge_depth = 0.01: give either hinge_depth or compressive_strength
s/one_sided'/two_block' hinge = 1/|bad.nml: &wall: hinge = 1: must lie between 0.01 and 0.99
s/one_sided'/two_block' overburden = -1/|bad.nml: &wall: overburden = -1: must lie between 0 and 1e9 N/m
s/one_sided'/two_block' eccentricity = 0.2/|bad.nml: &wall: eccentricity = 0.2: must lie between -0.125 and 0.125
s/one_sided'/two_block' bearing = 'inner'/|bad.nml: &wall: bearing_distance: must be given with bearing = 'inner'
s/one_sided'/two_block' bearing = 'centre' eccentricity = 0/|bad.nml: &wall: eccentricity = 0: give either eccentricity or bearing
s/one_sided'/free_standing' restitution = 'sorrentino'/|bad.nml: &wall: restitution = 'sorrentino': must be one of
s/one_sided'/one_sided' restitution = 'impulse' restitution_value = 0.5/|bad.nml: &wall: restitution_value = 0.5: give either it or
s/one_sided'/one_sided' restitution_value = 1/|bad.nml: &wall: restitution_value = 1: must be at least 0
s/one_sided'/one_sided' restitution_factor = 3/|bad.nml: &wall: restitution_factor = 3: makes the restitution e
s/task = 'stripes'/task = 'stripe'/|bad.nml: &job: task = 'stripe': must be one of 'history', 'stripes', 'typology'
s/task = 'stripes'/task = ''/|bad.nml: &job: task = '': must be one of
s/task = 'stripes'/task = 'typology'/|bad.nml: &population: must be given for task = 'typology'
s/threads = 2/threads = 2.0/|bad.nml: &job: threads = 2.0: must be an integer
s/threads = 2/threads = '2'/|bad.nml: &job: threads = '2': must be an integer without quotes
s/threads = 2/threads = -1/|bad.nml: &job: threads = -1: must lie between 0 (all) and 1024
s/threads = 2/threads = 5000/|bad.nml: &job: threads = 5000: must lie between 0 (all) and 1024
s/threads = 2/threads = 99999999999/|bad.nml: &job: threads = 99999999999: must be an integer of at most 2147483647
s/output = .*/output = ''/|bad.nml: &job: output = '': must not be empty
s/output = .*/output = 'out\/'/|bad.nml: &job: output = 'out/': must end in the beginning of a file's name
s/output = .*/output = 'good.nml\/x'/|bad.nml: &job: output = 'good.nml/x': the folder good.nml/ cannot be made
s/output = .*/output = '\/proc\/x\/y'/|bad.nml: &job: output = '/proc/x/y': the folder /proc/x/ cannot be made
s/output = .*/output = '\/proc\/y'/|bad.nml: &job: output = '/proc/y': the file /proc/y_histories.csv cannot be written
s/'It''s a wall'/'It's a wall'/|bad.nml: line 4: text right after the quote that closes 'It': a quote inside is doubled, 'L''Aquila'
s/name = 'wall, one'/name = 'wall, one/|bad.nml: line 9: the quote before 'wall, one' is not closed on its line
s/'records.records.csv'/records\/records.csv/|bad.nml: line 15: text right after a /: quote paths and other strings
s/'records.records.csv'/'records\/none.csv'/|bad.nml: &records: catalogue = 'records/none.csv': there is no file records/none.csv
s/'records.records.csv'/'records'/|bad.nml: &records: catalogue = 'records': records is a folder, must be a file
s/'records.records.csv'/'records\\records.csv'/|bad.nml: &records: catalogue = 'records\records.csv': there is no file records\records.csv (paths are relative to the case); folders must be separated by /, not \
s/output = .*/output = 'a\\b'/|bad.nml: &job: output = 'a\b': must have / between folders, not \
s#output = .*#output = '~/a/b'#|bad.nml: &job: output = '~/a/b': must be a path from the current folder or from /: ~ is not replaced as a shell does
s#output = .*#output = '$HOME/a'#|bad.nml: &job: output = '$HOME/a': must be a path from the current folder or from /: $ is not replaced as a shell does
s#output = .*#output = '.'#|bad.nml: &job: output = '.': must end in the beginning of a file's name, such as './wall'
s#output = .*#output = 'a/..'#|bad.nml: &job: output = 'a/..': must end in the beginning of a file's name, such as 'a/../wall'
s/'It''s a wall'/‘It is a wall’/|bad.nml: line 4: the quote ‘ of a word processor: must be a straight one, '
s/'It''s a wall'/“It is a wall”/|bad.nml: line 4: the quote “ of a word processor: must be a straight one, '
s/'It''s a wall'/«It is a wall»/|bad.nml: line 4: the quote « of a word processor: must be a straight one, '
s/'records.records.csv'/''/|bad.nml: &records: catalogue = '': must name a CSV table
s/^ *catalogue.*//|bad.nml: &records: catalogue: must be given
s/'both'/'backwards'/|bad.nml: &records: polarity = 'backwards': must be one of 'as_recorded', 'reversed', 'both'
s/'records.records.csv'/'good.nml'/|good.nml: 
s/'pga'/'pgx'/|bad.nml: &stripes: im = 'pgx': must be one of 'pga', 'pgv', 'pgd', 'arias', 'cav', 'arias-trapz', 'cav-trapz', 'hi', 'sa(T)', 'saavg(T1:T2)', 'pga/a0', 'p*pgv/a0'; T in s
s/'pga'/'sa(0,5)'/|bad.nml: &stripes: im = 'sa(0,5)': must be one of 'pga'
s/'pga'/'sa(30)'/|bad.nml: &stripes: im = 'sa(30)': must be one of 'pga'
s/'pga'/'d5-95'/|bad.nml: &stripes: im = 'd5-95': a duration does not change when a record is scaled
s/'pga'/'arias'/;s/0.6, 1.0/0.6, 1e9/|bad.nml: &stripes: levels = 1000000000: scales record
s/0.1, 0.2/0.2, 0.1/|bad.nml: &stripes: levels = 0.2, 0.1: must increase strictly
s/0.1, 0.2/0.2, 0.2/|bad.nml: &stripes: levels = 0.2, 0.2: must increase strictly (line 20)
s/0.1, 0.2/-0.1, 0.2/|bad.nml: &stripes: levels = -0.1: must be positive
s/0.1, 0.2/0.1,, 0.2/|bad.nml: &stripes: levels (line 20): a value is missing before a comma
s/0.1, 0.2/, 0.1, 0.2/|bad.nml: &stripes: levels (line 20): a value is missing before a comma
s/0.1, 0.2/0,1, 0,2/|bad.nml: &stripes: levels = 0,1, 0,2, 0.4, 0.6, ...: a decimal point is needed, such as 0.1
s/0.1, 0.2, 0.4,/1,5/;/0.6, 1.0/d|bad.nml: &stripes: levels = 1,5: a decimal comma, or several values? Write 1.5, or 1, 5 with a blank after the comma (line 20)
s/0.1, 0.2, 0.4,/0.5, 1,5/;/0.6, 1.0/d|bad.nml: &stripes: levels = 0.5, 1,5: a decimal comma, or several values? Write 1.5, or 1, 5 with
s/height = 3.0/height = 3.0, load_height = 2.5 load = 12,5e3/|bad.nml: &wall: load = 12,5e3: a decimal comma, or several values? Write 12.5e3, or 12, 5e3 with
s/0.1, 0.2/0.1, 0.2g/|bad.nml: &stripes: levels: value 2 = 0.2g: must be a number
s/0.1, 0.2/0.1, nan/|bad.nml: &stripes: levels: value 2 = nan: must be a number, such as 0.25 (line 20)
s/0.1, 0.2/0.1, '0.2'/|bad.nml: &stripes: levels: value 2 = '0.2': must be a number without quotes
s/0.6, 1.0/0.6, 1e6/|bad.nml: &stripes: levels = 1000000: scales record 'r1' beyond 10000 m/s2
s/im = 'pga'/im = 'pga' first = 0.1/|bad.nml: &stripes: last: must be given: first, last and count belong together
s/im = 'pga'/im = 'pga' first = 0.1, last = 0.5, count = 5/|bad.nml: &stripes: levels: give either levels or first, last and count
s/levels.*/first = 0.1, last = 0.5, count = 1/;/0.6, 1.0/d|bad.nml: &stripes: count = 1: must lie between 2 and 1000
s/levels.*/first = 0.1, last = 0.5, count = 2000000000/;/0.6, 1.0/d|bad.nml: &stripes: count = 2000000000: must lie between 2 and 1000
s/levels.*/first = 0.5, last = 0.1, count = 5/;/0.6, 1.0/d|bad.nml: &stripes: last = 0.1: must be greater than first = 0.5
s/levels.*/first = 0, last = 0.1, count = 5/;/0.6, 1.0/d|bad.nml: &stripes: first = 0: must be positive
s/levels.*//;/0.6, 1.0/d|bad.nml: &stripes: levels: must be given, such as levels = 0.1, 0.2, 0.3; or first, last and count (line 18)
s/'auto'/'rk4'/|bad.nml: &solver: engine = 'rk4': must be one of 'auto', 'rk45', 'lanes'
s/rtol = 1.0e-8/rtol = 1/|bad.nml: &solver: rtol = 1: must lie between
s/rtol = 1.0e-8/rtol = 1.0d-400/|bad.nml: &solver: rtol = 
s/atol = 1.0e-10/atol = 0/|bad.nml: &solver: atol = 0: must be positive
s/edp_limit = 1.0/edp_limit = 0/|bad.nml: &solver: edp_limit = 0: must be positive
s/edp_limit = 1.0/estimate_error = yes/|bad.nml: &solver: estimate_error = yes: must be .true. or .false.
s/edp_limit = 1.0/estimate_error = '.true.'/|bad.nml: &solver: estimate_error = '.true.': must be .true. or .false.
s/one_sided/two_block/;s/edp_limit = 1.0/edp_limit = 1000/|bad.nml: &solver: edp_limit = 1000: must be less than
s/gravity = 9.81/gravity = -9.81/|bad.nml: &solver: gravity = -9.81: must be positive (line 27)
s/gravity = 9.81/gravity = 9,81/|bad.nml: &solver: gravity = 9,81: must be one number; a decimal point is needed: 9.81
s/^(&wall)/\&population file = 'walls.csv' \/\n\1/|bad.nml: &population (line 8): not for task = 'stripes', which takes &wall
8,13d|bad.nml: &wall: must be given for task = 'stripes' (line 3)
14,17d|bad.nml: &records: catalogue: must be given
18,22d|bad.nml: &stripes: levels: must be given
13d|bad.nml: &wall: not closed: a / is missing before &records in line 13
$d|bad.nml: &solver: not closed: a / is missing at its end
s/^! a wall/a wall/|bad.nml: line 1: a is outside a group: must be &name ... /
s/^&wall/\& wall/|bad.nml: line 8: an & without the name of a group
s/^   threads = 2/   2 = threads/|bad.nml: &job: output (line 5): a second = follows it
s/^   threads = 2/   ,, threads = 2/|bad.nml: &job: output (line 5): a value is missing before a comma
s/^(&stripes)/\&history record = 5 \/\n\1/|bad.nml: &history: record = 5: must lie between 1 and 4, the number of records
s/^(&stripes)/\&history record = 0 \/\n\1/|bad.nml: &history: record = 0: must lie between 1 and 4
s/^(&stripes)/\&history record = 'r9' \/\n\1/|bad.nml: &history: record = 'r9': no such record; there are 'r1', 'r2', 'r3', 'r4'
s/^(&stripes)/\&history record = 1.5 \/\n\1/|bad.nml: &history: record = 1.5: must be an integer
s/^(&stripes)/\&history scale = 1, im_level = 2 \/\n\1/|bad.nml: &history: im_level: give either scale or im_level
s/^(&stripes)/\&history scale = -1 \/\n\1/|bad.nml: &history: scale = -1: must be positive
s/^(&stripes)/\&history im_level = 0 \/\n\1/|bad.nml: &history: im_level = 0: must be positive
s/task = 'stripes'/task = 'history'/|bad.nml: &records: polarity = 'both': must be 'as_recorded' or 'reversed' for task = 'history'
s/task = 'stripes'/task = 'history'/;s/'both'/'reversed'/;$s/$/\n\&history scale = 1e9 \//|bad.nml: &history: the scale 1000000000 makes record 'r1' exceed 10000 m/s2
s/^(&stripes)/\&check ag = 0.2, f0 = 2.5, tc_star = 0.35, soil = 'F' \/\n\1/|bad.nml: &check: soil = 'f': must be one of 'A', 'B', 'C', 'D', 'E'
s/^(&stripes)/\&check ag = 2, f0 = 2.5, tc_star = 0.35 \/\n\1/|bad.nml: &check: ag = 2: must lie between 0.001 and 1 g
s/^(&stripes)/\&check ag = 0.2, f0 = 2.5 \/\n\1/|bad.nml: &check: tc_star: must be given
s/^(&stripes)/\&check latitude = 39.22, longitude = 9.12, nominal_life = 50 \/\n\1/|bad.nml: &check: latitude = 39.22, longitude = 9.12: outside the grid of hazard
s/^(&stripes)/\&check ag = 0.2, latitude = 42.35, longitude = 13.4, nominal_life = 50 \/\n\1/|bad.nml: &check: ag: not with latitude and longitude
s/^(&stripes)/\&check ag = 0.2, f0 = 2.5, tc_star = 0.35, nominal_life = 50 \/\n\1/|bad.nml: &check: nominal_life: only with latitude and longitude
s/^(&stripes)/\&check ag = 0.2, f0 = 2.5, tc_star = 0.35, knowledge_factor = 1.5 \/\n\1/|bad.nml: &check: knowledge_factor = 1.5: must lie between 1 and 1.35
s/task = 'stripes'/task = 'history'/;s/'both'/'reversed'/;s/^(&stripes)/\&check ag = 0.2, f0 = 2.5, tc_star = 0.35 \/\n\1/|bad.nml: &check (line 18): not for task = 'history'
TABLE

# Names that would forge lines of result files, or move the cursor: ESC, U+0085, U+2028, U+2029
for bytes in '\x1b' '\xc2\x85' '\xe2\x80\xa8' '\xe2\x80\xa9'; do
   bad "s/wall, one/a${bytes}b/" "must be one line without control characters"
   bad "s/It''s a wall/a${bytes}b/" "must be one line without control characters"
   bad "s/out.deep.wall/a${bytes}b/" "must be one line without control characters"
done

# Output that would replace or hide what is there
mkdir -p taken_walls.csv
bad "s/output = .*/output = 'taken'/" "bad.nml: &job: output = 'taken': the result file taken_walls.csv is a folder"
rmdir taken_walls.csv
population >mine_walls.csv
population_case | sed "s/walls.csv/mine_walls.csv/; s/out.people/mine/" >mine.nml
refused "output over the population" "mine.nml: &job: output = 'mine': the result file mine_walls.csv would replace a file" \
   mine.nml
rm mine_walls.csv mine.nml

# --- wrong catalogues and records ----------------------------------------------------------------------------------

touch records/bad.csv
catalogue() {
   printf '%b' "$2" >records/bad.csv
   good_case | sed "s/records.csv/bad.csv/" >bad.nml
   refused "catalogue: $1" "$3" bad.nml
}
catalogue "a record that is not there" 'file,dt_s,units\nnone.txt,0.01,g\n' 'records/bad.csv: line 2: records/none.txt'
catalogue "no column file" 'name,dt_s,units\nr1.txt,0.01,g\n' "records/bad.csv: no column 'file'"
catalogue "a workbook" 'PK\0003\0004 xl/workbook.xml xl/styles.xml' \
   'records/bad.csv: seems to be a workbook of a spreadsheet (xlsx), not a text: save its table as CSV'
catalogue "no records" 'file,dt_s,units\n' 'records/bad.csv: no records'
catalogue "a decimal comma in dt" 'file,dt_s,units\nr1.txt,"0,01",g\n' "records/bad.csv: line 2: dt_s = '0,01': must be a number"
catalogue "an unknown unit" 'file,dt_s,units\nr1.txt,0.01,furlong\n' 'furlong'
catalogue "the same record twice" 'file,dt_s,units\nr1.txt,0.01,g\nr1.txt,0.01,g\n' "'r1.txt' is a duplicate"
catalogue "a name of two lines" 'file,dt_s,units,name\nr1.txt,0.01,g,"a\n# collapsed: 1"\n' \
   "records/bad.csv: line 2: name = 'a\n# collapsed: 1': must be one line without control characters"
catalogue "a name with a line separator" 'file,dt_s,units,name\nr1.txt,0.01,g,a\0342\0200\0250b\n' \
   "records/bad.csv: line 2: name = 'a\u2028b': must be one line"
printf '1\n2\nx\n' >records/broken.txt
catalogue "a broken record" 'file,dt_s,units\nbroken.txt,0.01,g\n' 'records/broken.txt: line 3'
rm records/broken.txt records/bad.csv
touch records/bad.csv

# --- wrong populations ---------------------------------------------------------------------------------------------

people() {
   printf '%b' "$2" >walls.csv
   refused "population: $1" "$3" people.nml
}
head='name,mechanism,height,thickness,weight\n'
people "unknown column" 'name,mechanism,heigth\na,one_sided,3\n' \
   "walls.csv: column 'heigth': no such column; did you mean 'height'? dondolo --template typology lists all; one that is only kept begins with x_ or note"
people "unknown column: none is near" 'name,mechanism,altezza\na,one_sided,3\n' \
   "walls.csv: column 'altezza': no such column; dondolo --template typology lists all; one that is only kept begins with x_ or note"
run --template typology
for column in building_height refine weight group p_occ; do
   check "unknown column: all that there are: $column" contains stdout "! $column "
done
people "a workbook" 'PK\0003\0004 xl/workbook.xml' 'walls.csv: seems to be a workbook of a spreadsheet (xlsx), not a text: save its table as CSV'
people "no walls" "$head" 'walls.csv: no walls under the header'
people "the same name twice" "${head}a,one_sided,3,0.3,1\na,one_sided,4,0.3,1\n" \
   "walls.csv: line 3: name = 'a': the row before gives this wall the same mechanism"
people "the same name elsewhere" "${head}a,one_sided,3,0.3,1\nb,one_sided,3,0.3,1\na,two_block,4,0.3,1\n" \
   "walls.csv: line 4: name = 'a': another wall has this name (line 2)"
people "a negative weight" "${head}a,one_sided,3,0.3,-1\n" 'walls.csv: line 2: weight = -1: must lie between 0 and'
people "no weight at all" "${head}a,one_sided,3,0.3,0\n" 'walls.csv: weight: must be positive for at least one wall'
people "a word for a number" "${head}a,one_sided,tall,0.3,1\n" "walls.csv: line 2: height = 'tall': must be a number"
people "nan" "${head}a,one_sided,3,nan,1\n" "walls.csv: line 2: thickness = 'nan': must be a number"
people "an empty cell that is required" "${head}a,one_sided,,0.3,1\n" 'walls.csv: line 2: height: must be given'
people "a negative thickness" "${head}\n# a comment\na,one_sided,3,-0.3,1\n" \
   'walls.csv: line 4: thickness = -0.3: must be positive'
people "unknown mechanism" "${head}a,arch,3,0.3,1\n" "walls.csv: line 2: mechanism = 'arch': must be one of"
people "a row too short" "${head}a,one_sided,3\n" 'walls.csv: line 2: 3 cells: must be 5'
printf '%b' "${head}a,one_sided,-3,0.3,1\nb,one_sided,3,0.3,1\nb,one_sided,3,0.3,1\nc,arch,-3,0.3,1\n" >walls.csv
run people.nml
check "population: everything wrong at once" equal "$(cut -c 1-40 stderr | tr '\n' ';')" \
   "dondolo: walls.csv: line 2: height = -3:;dondolo: walls.csv: line 4: name = 'b': ;dondolo: walls.csv: line 5: mechanism = ;dondolo: walls.csv: line 5: height = -3:;"
check "population: everything wrong at once: exit code" equal "$rc" 2
people "a name that would move the cursor" "${head}a\\0033[2Jb,one_sided,3,0.3,1\n" \
   "walls.csv: line 2: name = 'a\x1b[2Jb': must be one line without control characters"
awk 'BEGIN { print "name,mechanism,height,thickness"; print "\"a,one_sided,3,0.3"; for (i = 1; i <= 100000; i++) print "w" i ",one_sided,3,0.3" }' \
   >walls.csv
refused "population: a quote that is not closed" 'walls.csv: line 2: a double quote is not closed' people.nml
awk 'BEGIN { for (i = 1; i <= 100000; i++) printf "c%d,", i; print "name" }' >walls.csv
refused "population: 100001 columns" 'walls.csv: line 1: more than 10000 cells' people.nml
{ printf "$head"; head -c 20000000 /dev/zero | tr '\0' ','; echo; } >walls.csv
refused "population: a line of 20 MB" 'walls.csv: line 2: longer than 1048576 bytes' people.nml
people "semicolons and points" 'name;mechanism;height;thickness\na;one_sided;3,5;0.25\n' \
   "walls.csv: line 2: thickness = '0.25': must be a number, with a decimal comma as elsewhere in the table and no point"
people "decimal commas between commas" "${head}a,one_sided,3,5,0,25,1\n" \
   'walls.csv: line 2: 7 cells: must be 5 as in the header (columns separated by commas need decimal points)'
people "Windows-1252" "${head}a\0340,one_sided,3,0.25,1\nb\0340,one_sided,3,0.25,1\n" \
   'walls.csv: line 2: byte 2 (E0) is not UTF-8 (Windows-1252?): save it as UTF-8 (Excel: Save As, CSV UTF-8; Notepad: Save As, Encoding UTF-8)'
people "an empty file" '' 'walls.csv: the file is empty'
rm walls.csv
refused "population: no file" "people.nml: &population: file = 'walls.csv': there is no file walls.csv" people.nml
population_case | sed "s/file = .*/ \//" >bad.nml
refused "population: file not given" 'bad.nml: &population: file: must be given' bad.nml
{ population_case; echo "&wall mechanism = 'one_sided' /"; } >bad.nml
refused "population and a wall" "bad.nml: &wall (line 5): not for task = 'typology', which takes &population" bad.nml

# --- failures while running ----------------------------------------------------------------------------------------

if on_posix && [ -c /dev/full ]; then
   for arguments in --version --help '--template stripes' '--check good.nml' good.nml; do
      # shellcheck disable=SC2086
      timeout 60 "$exe" $arguments >/dev/full 2>stderr
      check "full standard output, $arguments: exit code" equal "$?" 1
      check "full standard output, $arguments: says so" contains stderr 'dondolo: standard output: cannot be written whole'
   done
fi

# Limits of a process
if on_posix; then
   # A limit on the size of files is met like a full disk
   awk 'BEGIN { print "name,mechanism,height,thickness"; for (i = 1; i <= 40; i++) print "w" i ",one_sided,3,0.3" }' >walls.csv
   population_case | sed "s/levels = .*/levels = 0.01 \//" >limit.nml
   rm -rf out
   (ulimit -f 4; timeout 60 "$exe" good.nml >/dev/null 2>"$work/stderr"; echo $? >"$work/rc")
   check "file limit, a wall: exit code" equal "$(cat rc)" 1
   check "file limit, a wall: says so" equal "$(cat stderr)" \
      'dondolo: out/deep/wall_histories.csv: cannot be written whole: is the disk full?'
   check "file limit, a wall: no file left" equal "$(find out 2>/dev/null)" ""
   (ulimit -f 4; timeout 60 "$exe" limit.nml >/dev/null 2>"$work/stderr"; echo $? >"$work/rc")
   check "file limit: exit code" equal "$(cat rc)" 1
   check "file limit: says so" contains stderr 'cannot be written whole: is the disk full?'
   check "file limit: no table left" equal "$(find . -name 'people_*')" ""
   rm -rf out walls.csv limit.nml

   # Too little memory: one line
   good_case | sed 's/levels = .*/first = 0.01, last = 1.0, count = 1000/; s/^ *0.6, 1.0$//' >memory.nml
   awk 'BEGIN { print "file,dt_s,units,name"; for (i = 1; i <= 2000; i++) print "r1.txt,0.01,m/s2,n" i }' >records/many.csv
   sed 's/records.csv/many.csv/' memory.nml >many.nml
   (ulimit -v 300000; timeout 60 "$exe" --threads 1 many.nml >/dev/null 2>"$work/stderr"; echo $? >"$work/rc")
   check "memory: exit code" equal "$(cat rc)" 1
   check "memory: one line, not: $(cat stderr)" equal "$(grep -c '^dondolo: .*not enough memory: needs [0-9]* MB$' stderr)/$(wc -l <stderr)" 1/1
   check "memory: no file" equal "$(find out -type f 2>/dev/null)" ""
   rm -rf out records/many.csv memory.nml many.nml
fi

# --- counts of parts -----------------------------------------------------------------------------------------------

population >walls.csv
run --walls 2:2 people.nml
check "part: exit code" equal "$rc" 0
check "part: says how to go on" contains stdout 'dondolo --merge people.nml out/people_walls_*.counts'
run --walls 2:2 people.nml
check "part: an earlier run had it" contains stdout '16 histories, those of 1 row by an earlier run'
if on_posix; then mkfifo pipe; fi
for word in 0:5 5:1 1: : 1:2:3 -1:2 1.5:2 a:b 3000000000:3000000001; do
   refused "--walls $word" "--walls $word: must be the first and the last row" --walls "$word" people.nml
done
refused "--walls behind the end" '--walls 7:9: the population has 2 rows' --walls 7:9 people.nml
refused "--merge without files" '--merge: the files of counts must follow the case' --merge people.nml
refused "--merge with --walls" '--walls: cannot go together with --merge' --walls 1:2 --merge people.nml x
refused "--merge: a row is missing" '--merge: row 1 of 2 is missing from the files' --merge people.nml out/people_walls_2-2.counts
refused "--merge: the case itself" 'people.nml: not a dondolo counts file' --merge people.nml people.nml
refused "--merge: a folder" 'records: not a dondolo counts file' --merge people.nml records
on_posix && refused "--merge: a pipe" 'pipe: is a pipe, not a regular file' --merge people.nml pipe
refused "--merge: nothing" 'none: no such file, or nothing in it' --merge people.nml none
rm -rf out walls.csv pipe

# --- warnings ------------------------------------------------------------------------------------------------------

# warned CHANGE PART: the case runs, and warns on stderr and in the results
warned() {
   good_case | sed -E -e "$1" >warn.nml
   run warn.nml
   check "warning, $1: exit code" equal "$rc" 0
   check "warning, $1: $2, not: $(cat stderr)" grep -q "^dondolo: warning: .*$2" stderr
   check "warning, $1: in the results" grep -q "^# warning: .*$2" out/deep/wall_fragility.csv
   rm -rf out
}
warned 's/0.6, 1.0/0.6, 5.0/' 'scale factors above 10 in 6 of 40 histories, the largest 25'
warned 's/levels.*/levels = 0.01, 0.02/;/0.6, 1.0/d' 'no motion at levels 0.01 to 0.02, no curve is fitted: the wall begins to rock at a PGA of 0.08333 g'
warned 's/levels.*/levels = 0.09, 0.1/;/0.6, 1.0/d' 'no collapse at levels 0.09 to 0.1'
warned 's/levels.*/levels = 2, 3/;/0.6, 1.0/d;s/height = 3.0/height = 1.0/;s/0.25/0.05/' 'every history collapses at levels 2 to 3'
warned 's/height = 3.0/height = 300/' "wall '.*': height = 300 m is more than 60 m: is it in centimetres?"
warned 's/thickness = 0.25/thickness = 25/' "wall '.*': thickness = 25 m is more than 3 m: is it in centimetres?"
warned 's/thickness/density = 18 thickness/' "density = 18 kg/m3 is less than 500 kg/m3: is it in kN/m3 or t/m3?"
warned 's/thickness/density = 1.800 thickness/' "density = 1.8 kg/m3 is less than 500 kg/m3: is it in kN/m3 or t/m3?"
warned 's/thickness/interlock_overlap = 0.1 interlock_course = 0.01 interlock_thickness = 0.3 interlock_spacing = 5 thickness/' \
   "interlock_course = 0.01 m is less than 0.03 m: is it the height of a joint?"
warned 's/thickness/interlock_overlap = 0.1 interlock_course = 0.1 interlock_thickness = 0.3 interlock_spacing = 0.5 thickness/' \
   "interlock_spacing = 0.5 m is less than 1 m: is it a thickness?"
warned 's/thickness/interlock_overlap = 0.1 interlock_course = 0.1 interlock_thickness = 0.3 interlock_spacing = 5 interlock_friction = 2 thickness/' \
   "interlock_friction = 2 is more than 1: is it an angle, or in per cent?"
warned 's/thickness/tie_height = 2.8 tie_area = 1e-4 tie_length = 5 tie_preload = 50 thickness/' \
   "tie_preload = 50 Pa is less than 100000 Pa: is it in MPa, or a force?"
warned "s/one_sided'/two_block' overburden = 15 overburden_inertia = 0/" "overburden = 15 N/m is less than 200 N/m: is it in kN/m?"
warned 's/gravity = [0-9.]+/gravity = 981/' "wall '.*': gravity = 981 m/s2 is more than 10 m/s2: is it in cm/s2 or ft/s2?"
warned 's/gravity = [0-9.]+/gravity = 1/' "wall '.*': gravity = 1 m/s2 is less than 9.7 m/s2: is it in g?"
for polarity in both reversed; do
   good_case | sed "s/'both'/'$polarity'/; \$s/\$/\n\&check ag = 0.2, f0 = 2.5, tc_star = 0.35 \//" >one_way.nml
   run one_way.nml
   check "the criterion with $polarity records: exit code" equal "$rc" 0
   check "the criterion with $polarity records: note of one direction" equal "$(grep -c 'takes each record in one direction only' stderr)" \
      "$([ $polarity = both ] && echo 0 || echo 1)"
done
rm -rf out
awk 'BEGIN { for (k = 0; k < 10; k++) print 0 }' >records/still.txt
cp records/records.csv records/bad.csv
echo 'still.txt,0.01,g,here' >>records/bad.csv
good_case | sed 's/records.csv/bad.csv/' >still.nml
refused "a record without motion" "still.nml: &records: record 'still': has no motion (its PGA is 0): must be left out" still.nml
refused "a record without motion, --check" "&records: record 'still': has no motion" --check still.nml
population >walls.csv
population_case | sed 's/records.csv/bad.csv/' >dead.nml
refused "a record without motion of a population" "dead.nml: &records: record 'still': has no motion" dead.nml
awk 'BEGIN { for (k = 0; k < 900; k++) print 0.2 }' >records/still.txt
refused "a channel that is stuck" "record 'still': has no motion (all its samples are 1.96133 m/s2): must be left out" still.nml
cp records/records.csv records/bad.csv
awk 'BEGIN { for (k = 0; k < 10; k++) print 100 * k }' >records/strong.txt
echo 'strong.txt,0.01,g,here' >>records/bad.csv
warned 's/records.csv/bad.csv/' "record 'strong': a PGA of 899.7 g, more than 3 g: wrong units? (1 of 5 records)"
good_case | sed 's/records.csv/bad.csv/; s/thickness/density = 18 thickness/; s/0.6, 1.0/0.6, 5.0/' >warn.nml
run --check warn.nml
check "check: problems of a record" grep -qE ' strong .*  a PGA of 899.7 g, more than 3 g: wrong units\?; ' stdout
check "check: warnings last" equal "$(tail -n 6 stdout | cut -c 1-24 | tr '\n' ';')" \
   ";warning: wall 'wall, one;warning: record 'strong';warning: no event is giv;warning: levels up to 5 ;warning: scale factors a;"
warned 's/height = 3.0/height = 0.2/' "wall 'wall, one': the height is less than the thickness: are they swapped?"
warned 's/thickness/interlock_overlap = 0.4 interlock_course = 0.1 interlock_thickness = 0.3 interlock_spacing = 5 thickness/' \
   "wall 'wall, one': interlock_overlap is more than the thickness of the wall: is it the length of a stone?"
warned "s/one_sided'/two_block' bearing = 'centre'/" \
   "wall 'wall, one': a bearing or an eccentricity without overburden changes nothing: is the overburden missing?"
good_case | sed "s/one_sided'/two_block' overburden = 8000 overburden_inertia = 0 bearing = 'inner' bearing_distance = 0.06/" >good2.nml
run --check good2.nml
check "check: where the load bears" contains stdout '  load 8000 N/m, 0.06 m from the inner face, folding outwards'
run good2.nml
check "a bearing is an eccentricity in the results" contains out/deep/wall_fragility.csv ' eccentricity = -0.065'
rm -rf out
awk 'BEGIN { for (k = 0; k < 10; k++) print 1 }' >records/strong.txt
good_case | sed "s/'stripes'/'history'/; s/'both'/'reversed'/; s/records.csv/bad.csv/; \$s/\$/\n\&history record = 5, im_level = 1 \//" >bad.nml
refused "a record without motion to a level" \
   "bad.nml: &history: im_level = 1: record 'strong': has no motion (all its samples are 9.80665 m/s2): must be left out" bad.nml

echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
