#!/usr/bin/env bash
# Installs what is missing, builds everything and runs the tests:
#   ./test.sh [--ci | --all] [CTEST ARGUMENT...]
# --ci: first also the readers of files under sanitizers, and the commands of the documents.
# --all: before that every file by itself.
set -euo pipefail
root=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
source "$root/.ci/setup"
cd "$root"

# Each file includes what it uses: compiled by itself, and not further than that is seen.
check_single_files() {
  configure single-files
  build single-files
}

# What reads files is tested under the address and undefined-behaviour sanitizers, and fuzzed; what
# only computes is left out, and of random domains three of four quarters. The fuzz targets damage
# files more cleverly than the random mistakes do, so a few hundred of these are enough here. By
# hand, for all tests under the sanitizers: cmake --preset asan-ubsan &&
# cmake --build --preset asan-ubsan && ctest --preset asan-ubsan; for all tests of the planner
# without MuJoCo: likewise with planner-only.
readers=(base numeric algebra network domain plan contingent)
build_readers_with_sanitizers() {
  configure asan-ubsan
  build asan-ubsan "${readers[@]/%/_test}" tests/fuzz/all
}
test_readers_with_sanitizers() {
  ASSAY_MUTATIONS=500 with_progress "Testing with sanitizers" \
    ctest --preset asan-ubsan --tests-regex "^($(IFS='|' && echo "${readers[*]}"))\.|^fuzz\." \
    --exclude-regex "^domain\.((HandClearance|StablePose|Grasp)Test|ToolPath|PegAndBlock|ShaftFit|Scenarios)\.|^plan\.FourStepPlan\.|^contingent\.Quarters/(Random|Rich)Domains\..*/[123]$"
}

# Prints the commands that call the program or the scripts here, from the ```sh blocks of README.md,
# which installs the program, and then of the pages for users.
document_commands() {
  sed -n '/^```sh$/,/^```$/p' README.md planner/*.md sim/*.md scenarios/*.md |
    sed ':more; /\\$/ { N; s/\\\n//; b more }' |
    grep -E '^(\./|assay )' | grep -v '^\./test\.sh' | awk '!seen[$0]++'
}

# As somebody who follows the documents, with a home of their own.
test_document_commands() {
  local commands command home
  mapfile -t commands < <(document_commands)
  [ ${#commands[@]} -gt 0 ] || { echo "The documents show no commands" >&2; return 1; }
  home=$(mktemp -d)
  for command in "${commands[@]}"; do
    HOME=$home PATH="$home/.local/bin:$PATH" \
      with_progress "Documents: $command" bash -euo pipefail -c "$command"
  done
  rm -rf "$home"
}

install_missing_packages
configure release -DASSAY_TESTS=ON -DASSAY_BENCH=ON -DASSAY_PYTHON=ON
build release
stage=${1:-}
[[ $stage != --all ]] || check_single_files
if [[ $stage == --all || $stage == --ci ]]; then
  shift
  build_readers_with_sanitizers
  # Most commands of the documents keep one core busy.
  test_document_commands &
  documents=$!
  test_readers_with_sanitizers
  wait "$documents"
fi
with_output_and_progress "Testing" ctest --preset release "$@"
