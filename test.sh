#!/usr/bin/env bash
# Installs what is missing, builds everything and runs the tests: ./test.sh [--all] [CTEST ARGUMENT...]
# --all: first also the planner without MuJoCo, the sanitizers, and the commands of README.md.
set -euo pipefail
root=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
source "$root/.ci/setup"
cd "$root"

# The planner builds and passes its tests without anything of the simulator. The longest ones run
# once, in the release build: the code is the same.
test_planner_only() {
  build planner-only
  quietly ctest --preset planner-only --exclude-regex '^(algebra|uncertainty|posting)\.'
}

# The readers of files, under the address and undefined-behaviour sanitizers. By hand, for all tests:
# cmake --preset asan-ubsan && cmake --build --preset asan-ubsan && ctest --preset asan-ubsan
test_with_sanitizers() {
  local libraries=(base algebra network domain plan contingent)
  build asan-ubsan "${libraries[@]/%/_test}"
  ASSAY_MUTATIONS=10000 quietly ctest --preset asan-ubsan --tests-regex "^($(IFS='|' && echo "${libraries[*]}"))\."
}

# Prints the commands in README.md's ```sh blocks that call the program or the scripts here.
readme_commands() {
  sed -n '/^```sh$/,/^```$/p' README.md | sed ':more; /\\$/ { N; s/\\\n//; b more }' |
    grep -E '^(\./|assay )' | grep -v '^\./test\.sh'
}

test_readme_commands() {
  local commands command
  mapfile -t commands < <(readme_commands)
  [ ${#commands[@]} -gt 0 ] || { echo "README.md shows no commands" >&2; return 1; }
  for command in "${commands[@]}"; do
    echo "README.md: $command" >&2
    PATH="$root/build/release/bin:$PATH" quietly bash -euo pipefail -c "$command"
  done
}

install_missing_packages
build release
if [ "${1:-}" = --all ]; then
  shift
  test_planner_only
  test_with_sanitizers
  test_readme_commands
fi
exec ctest --preset release "$@"
