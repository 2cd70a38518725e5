#!/usr/bin/env bash
# Times every engine beside its peers and writes bench/REPORT.md and bench/plots/.
#   bench/run.sh [--passes N] [--seconds S] [--seed N] [--only PATTERN] [--tiny]
# A program is measured in several passes, one after the other. In a pass the contestants of an instance
# take turns, so that other work of the machine disturbs all of them alike. The measurements stay in
# build/release/bench/results. --seed takes other random networks, chains and poses. --only takes the
# programs that match. --tiny does little work, once. With any of these three options the report is
# written into build/release/bench/REPORT.md. The variables ASSAY_BENCH_SEED and ASSAY_BENCH_TINY of the
# environment mean the same as the options. If ASSAY_CONTINGENT names a folder of public problems of
# contingent planning, bench/CONTINGENT.md is written, too. The exit code is 0 after a measurement, 2 for
# a wrong command line, and 12 if a contestant answered wrong, which the report says first.
set -euo pipefail
cd "$(dirname "$0")/.."
passes= seconds= only= report=bench/REPORT.md plots=bench/plots contingent=bench/CONTINGENT.md
build=build/release/bench
usage() { sed -n '2,/^[^#]/s/^# \?//p' bench/run.sh; }
refuse() { echo "$*" >&2; exit 2; }
elsewhere() { report=$build/REPORT.md plots=$build/plots; }

while (($#)); do
  case $1 in
    --help | -h) usage; exit ;;
    --tiny) export ASSAY_BENCH_TINY=1; shift; continue ;;
    --passes | --seconds | --seed | --only) [[ -n ${2-} ]] || refuse "$1 has no value" ;;
    *) refuse "unknown option $1; allowed: --passes N, --seconds S, --seed N, --only PATTERN, --tiny, --help" ;;
  esac
  case $1 in
    --passes) passes=$2 ;;
    --seconds) seconds=$2 ;;
    --seed) export ASSAY_BENCH_SEED=$2 ;;
    --only) only=$2; elsewhere ;;
  esac
  shift 2
done
if [[ ${ASSAY_BENCH_TINY:-0} != 0 ]]; then
  elsewhere
  contingent=$build/CONTINGENT.md passes=${passes:-1} seconds=${seconds:-0.001}
fi
: "${passes:=5}" "${seconds:=0.1}"
[[ $passes =~ ^[1-9][0-9]*$ ]] || refuse "--passes is \"$passes\"; allowed: a whole number from 1 on"
[[ $seconds =~ ^[0-9]*\.?[0-9]+$ && $seconds == *[1-9]* ]] ||
  refuse "--seconds is \"$seconds\"; allowed: a positive number"
if [[ -v ASSAY_BENCH_SEED ]]; then
  greatest=18446744073709551615
  elsewhere
  [[ $ASSAY_BENCH_SEED =~ ^(0|[1-9][0-9]{0,18})$ || ($ASSAY_BENCH_SEED =~ ^[1-9][0-9]{19}$ &&
    ! $ASSAY_BENCH_SEED > $greatest) ]] ||
    refuse "the seed is \"$ASSAY_BENCH_SEED\"; allowed: a whole number of 0 .. $greatest"
fi
# sweep times threads; it takes turns and reports by itself.
mapfile -t all < <(basename -a -s _bench.cc bench/*_bench.cc | grep -vx sweep)
programs=()
for name in "${all[@]}"; do
  if [[ $name =~ $only ]]; then programs+=("$name"); fi
done
((${#programs[@]})) || refuse "--only $only matches none of the programs: ${all[*]}"

root=$PWD
source .ci/setup
install_missing_packages program benchmarks
# A build folder that is configured with tests stays so.
if [[ -e build/release/CMakeCache.txt ]]; then
  configure release -DASSAY_BENCH=ON
else
  configure release -DASSAY_BENCH=ON -DASSAY_TESTS=OFF
fi
build release bench/all
read -r load_before _ </proc/loadavg
results=$build/results
rm -rf "$results"
mkdir -p "$results" "$plots"
processor=$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -1)
compiler=$(c++ --version | head -1)
build_type=$(sed -n 's/^CMAKE_BUILD_TYPE:[A-Z]*=//p' build/release/CMakeCache.txt)
revision=$(git describe --always --dirty 2>/dev/null || echo unknown)
for pass in $(seq "$passes"); do
  for name in "${programs[@]}"; do
    program=$build/${name}_bench
    [[ -x $program ]] || continue # without the simulator
    echo "pass $pass of $passes: $name" >&2
    "$program" --benchmark_min_time="$seconds" --benchmark_out_format=json \
      --benchmark_out="$results/$name.$pass.json" --benchmark_context=processor="${processor//,/}" \
      --benchmark_context=compiler="${compiler//,/}" --benchmark_context=revision="$revision" \
      --benchmark_context=passes="$passes" --benchmark_context=seed="${ASSAY_BENCH_SEED:-1}" \
      --benchmark_context=build_type="$build_type" --benchmark_context=load_before="$load_before" \
      >"$results/$name.$pass.txt"
  done
done
wrong_answers=12 told=0
"$build/summarize" report "$report" "$results/plots.gp" "$results"/*.json || told=$?
((told == 0 || told == wrong_answers)) || exit "$told"
if [[ -n ${ASSAY_CONTINGENT:-} && -e $results/contingent.1.json ]]; then
  "$build/summarize" contingent "$contingent" "$results"/contingent.*.json || told=$?
  echo "$contingent"
fi
(cd "$plots" && gnuplot "$OLDPWD/$results/plots.gp")
echo "$report"
exit "$told"
