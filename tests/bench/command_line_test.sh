#!/usr/bin/env bash
# command_line_test.sh SUMMARIZE: what bench/run.sh takes, where it writes, how it ends. It runs in a
# folder where programs that print prepared results stand for the benchmarks, and nothing is built.
set -euo pipefail
summarize=$1
source=$(dirname "$(readlink -f "$0")")/../..
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
unset ASSAY_BENCH_SEED ASSAY_BENCH_TINY ASSAY_CONTINGENT
fail() { echo "$*" >&2; exit 1; }

prepare() {
  mkdir -p "$here"/{.ci,bin,bench,build/release/bench}
  cp "$source/.ci/setup" "$here/.ci"
  touch "$here/packages.txt"
  cp "$source/bench/run.sh" "$here/bench"
  cp "$summarize" "$here/build/release/bench"
  touch "$here"/bench/{bounds,labeling,sweep}_bench.cc "$here/build/release/CMakeCache.txt"
  printf '#!/bin/sh\ntouch %s/built\n' "$here" >"$here/bin/cmake"
  printf '#!/bin/sh\n' >"$here/bin/gnuplot"
  cat >"$here/build/release/bench/labeling_bench" <<'EOF'
#!/usr/bin/env bash
for argument; do
  [[ $argument != --benchmark_out=* ]] || cp "$ANSWERS" "${argument#*=}"
done
EOF
  cp "$here"/build/release/bench/{labeling,bounds}_bench
  chmod +x "$here"/bin/* "$here"/build/release/bench/*_bench
  answers '"cpu_time": 8, "time_unit": "us"' >"$here/right.json"
  answers '"error_occurred": true, "error_message": "its answer is not ours"' >"$here/wrong.json"
}

answers() {
  echo '{"context": {"executable": "labeling_bench"}, "benchmarks": [
    {"name": "labeling/a/assay", "run_type": "iteration", "cpu_time": 1, "time_unit": "us"},
    {"name": "labeling/a/gecode", "run_type": "iteration", '"$1"'}]}'
}

# ends CODE ARGUMENT...: in `said` is what it printed.
ends() {
  local code=$1 got=0
  shift
  rm -rf "$here"/{built,bench/REPORT.md,build/release/bench/REPORT.md}
  said=$(PATH=$here/bin:$PATH ANSWERS=$here/${answers:-right.json} "$here/bench/run.sh" "$@" 2>&1) || got=$?
  ((got == code)) || fail "run.sh $*: exit code $got instead of $code: $said"
}

refuses() {
  ends 2 "$@"
  [[ ! -e $here/built ]] || fail "run.sh $*: built before it refused"
}

writes() { [[ -e $here/$1/REPORT.md && ! -e $here/$2/REPORT.md ]] || fail "not in $1 alone"; }

prepare
for option in --passes --seconds --seed --only; do refuses $option; done
for passes in 0 -1 1.5 many; do refuses --passes $passes; done
for seconds in 0 0.0 -1 . long; do refuses --seconds $seconds; done
for seed in -1 1.5 any 18446744073709551616; do
  refuses --seed $seed
  ASSAY_BENCH_SEED=$seed refuses
done
refuses --fast
refuses --only nothing
[[ $said == *"bounds labeling" ]] || fail "the programs are not told: $said"

for help in --help -h; do
  ends 0 $help
  [[ $said == *"bench/run.sh [--passes N]"* && $said != *"set -e"* ]] || fail "no usage: $said"
done

ends 0 --passes 2
writes bench build/release/bench
[[ $said == *"pass 2 of 2: labeling"* && $said != *sweep* ]] || fail "not all programs: $said"
for elsewhere in "--seed 18446744073709551615" "--only lab" --tiny; do
  ends 0 $elsewhere --passes 1
  writes build/release/bench bench
done
ASSAY_BENCH_SEED=2 ends 0
writes build/release/bench bench
ASSAY_BENCH_TINY=1 ends 0
writes build/release/bench bench

answers=wrong.json ends 12
writes bench build/release/bench
grep -q 'labeling/a/gecode: \*\*its answer is not ours' "$here/bench/REPORT.md" || fail "not told"
