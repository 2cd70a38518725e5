#!/usr/bin/env bash
# Times every engine beside its peers and writes bench/REPORT.md and bench/plots/.
#   bench/run.sh [--passes N] [--seconds S] [--seed N] [--only PATTERN] [--tiny]
# Passes over a program come one after another, and in a pass the contestants of an instance take
# turns, so that what else the machine does falls on all of them. What was measured stays in
# build/release/bench/results. --seed: random networks, chains, poses that nobody has seen; --only:
# programs that match; both write into build/release/bench/REPORT.md. Where ASSAY_CONTINGENT names a
# folder of public problems of contingent planning, bench/CONTINGENT.md is written as well.
set -euo pipefail
cd "$(dirname "$0")/.."
passes=5 seconds=0.1 only= report=bench/REPORT.md plots=bench/plots contingent=bench/CONTINGENT.md
build=build/release/bench
elsewhere() { report=$build/REPORT.md plots=$build/plots; }
while (($#)); do
  case $1 in
    --passes) passes=$2; shift 2 ;;
    --seconds) seconds=$2; shift 2 ;;
    --seed) export ASSAY_BENCH_SEED=$2; elsewhere; shift 2 ;;
    --only) only=$2; elsewhere; shift 2 ;;
    --tiny) export ASSAY_BENCH_TINY=1; passes=1 seconds=0.001; elsewhere
      contingent=$build/CONTINGENT.md; shift ;;
    *) echo "unknown option $1; allowed: --passes N, --seconds S, --seed N, --only PATTERN, --tiny" >&2; exit 2 ;;
  esac
done

read -r load_before _ </proc/loadavg
cmake --preset release >/dev/null
cmake --build --preset release --target bench/all
results=$build/results
rm -rf "$results"
mkdir -p "$results" "$plots"
processor=$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -1)
compiler=$(c++ --version | head -1)
build_type=$(sed -n 's/^CMAKE_BUILD_TYPE:[A-Z]*=//p' build/release/CMakeCache.txt)
revision=$(git describe --always --dirty 2>/dev/null || echo unknown)
for pass in $(seq "$passes"); do
  for program in "$build"/*_bench; do
    name=$(basename "$program" _bench)
    [[ $name =~ $only ]] || continue
    [[ $name == sweep ]] && continue  # threads; it takes turns and reports by itself
    echo "pass $pass of $passes: $name" >&2
    "$program" --benchmark_min_time="$seconds" --benchmark_out_format=json \
      --benchmark_out="$results/$name.$pass.json" --benchmark_context=processor="${processor//,/}" \
      --benchmark_context=compiler="${compiler//,/}" --benchmark_context=revision="$revision" \
      --benchmark_context=passes="$passes" --benchmark_context=seed="${ASSAY_BENCH_SEED:-1}" \
      --benchmark_context=build_type="$build_type" --benchmark_context=load_before="$load_before" \
      >"$results/$name.$pass.txt"
  done
done
"$build/summarize" report "$report" "$results/plots.gp" "$results"/*.json
if [[ -n ${ASSAY_CONTINGENT:-} && -e $results/contingent.1.json ]]; then
  "$build/summarize" contingent "$contingent" "$results"/contingent.*.json
  echo "$contingent"
fi
(cd "$plots" && gnuplot "$OLDPWD/$results/plots.gp")
echo "$report"
