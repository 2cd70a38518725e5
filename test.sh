#!/usr/bin/env bash
# Installs what is missing, builds everything and runs the tests: ./test.sh [--all] [CTEST ARGUMENT...]
# --all: first also every file by itself, the planner without MuJoCo, the sanitizers, and the commands
# of README.md.
set -euo pipefail
root=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
source "$root/.ci/setup"
cd "$root"

# Each file includes what it uses: compiled by itself, and not further than that is seen.
check_single_files() {
  configure single-files
  build single-files
}

# The planner builds and passes its tests without anything of the simulator. The longest ones run
# once, in the release build: the code is the same.
test_planner_only() {
  configure planner-only
  build planner-only
  with_progress "Testing planner-only" \
    ctest --preset planner-only --exclude-regex '^(algebra|uncertainty|posting)\.'
}

# The readers of files, under the address and undefined-behaviour sanitizers. By hand, for all tests:
# cmake --preset asan-ubsan && cmake --build --preset asan-ubsan && ctest --preset asan-ubsan
test_with_sanitizers() {
  local libraries=(base algebra network domain plan contingent)
  configure asan-ubsan
  build asan-ubsan "${libraries[@]/%/_test}"
  ASSAY_MUTATIONS=10000 with_progress "Testing with sanitizers" \
    ctest --preset asan-ubsan --tests-regex "^($(IFS='|' && echo "${libraries[*]}"))\."
}

# Prints the commands in README.md's ```sh blocks that call the program or the scripts here.
readme_commands() {
  sed -n '/^```sh$/,/^```$/p' README.md | sed ':more; /\\$/ { N; s/\\\n//; b more }' |
    grep -E '^(\./|assay )' | grep -v '^\./test\.sh'
}

# As somebody who follows README.md, with a home of their own.
test_readme_commands() {
  local commands command home
  mapfile -t commands < <(readme_commands)
  [ ${#commands[@]} -gt 0 ] || { echo "README.md shows no commands" >&2; return 1; }
  home=$(mktemp -d)
  for command in "${commands[@]}"; do
    HOME=$home PATH="$home/.local/bin:$PATH" \
      with_progress "README.md: $command" bash -euo pipefail -c "$command"
  done
  rm -rf "$home"
}

install_missing_packages
configure release -DASSAY_TESTS=ON -DASSAY_BENCH=ON
build release
if [ "${1:-}" = --all ]; then
  shift
  check_single_files
  test_planner_only
  test_with_sanitizers
  test_readme_commands
fi
with_output_and_progress "Testing" ctest --preset release "$@"
