#!/usr/bin/env bash
# Installs what is missing, builds everything and runs the tests:
#   ./test.sh [--ci | --all] [CTEST ARGUMENT...]
# --ci: first tests the readers of files under sanitizers, and runs the commands of the documents.
# --all: as --ci, but first compiles every file by itself.
set -euo pipefail
root=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
source "$root/.ci/setup"
cd "$root"

# Compiles each file by itself, without writing code. This shows whether a file includes what it uses.
check_single_files() {
  configure single-files
  build single-files
}

# Libraries that read files, and the numbers that all of them use, are tested under the address and
# undefined-behaviour sanitizers, and readers are fuzzed. Tests that only compute are left out, and so
# are three of the four quarters of random domains. The fuzz targets damage files more cleverly than the
# random mistakes of the tests do, so a few hundred of these mistakes are enough here. tests/README.md
# has the commands that run all tests under sanitizers, and all tests of the planner without MuJoCo.
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

# Prints the commands in the ```sh blocks of README.md and of the pages for users that call the program
# or the scripts in this folder. README.md comes first, because its commands install the program.
document_commands() {
  sed -n '/^```sh$/,/^```$/p' README.md planner/*.md sim/*.md scenarios/*.md |
    sed ':more; /\\$/ { N; s/\\\n//; b more }' |
    grep -E '^(\./|assay )' | grep -v '^\./test\.sh' | awk '!seen[$0]++'
}

# Runs the commands as a user would who follows the documents, with a home folder of its own.
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
documents=
if [[ $stage == --all || $stage == --ci ]]; then
  shift
  build_readers_with_sanitizers
  # Most commands of the documents keep one core busy, so they run beside the tests.
  test_document_commands &
  documents=$!
  trap 'kill "$documents" 2>/dev/null || true' EXIT
  test_readers_with_sanitizers
fi
with_output_and_progress "Testing" ctest --preset release "$@"
[ -z "$documents" ] || wait "$documents"
