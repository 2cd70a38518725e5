#!/usr/bin/env bash
# Installs what is missing, builds everything and runs the tests: ./test.sh [--all] [CTEST ARGUMENT...]
# --all: first also the planner without MuJoCo, the sanitizers, and the commands of README.md.
set -euo pipefail
root=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
source "$root/.ci/setup"
cd "$root"

# The planner configures, builds and passes its tests with everything of the simulator hidden.
test_planner_only() {
  build planner-only
  quietly ctest --preset planner-only
}

# Under the address and undefined-behaviour sanitizers: the readers of files, and the planner.
test_with_sanitizers() {
  build asan-ubsan base_test network_test
  quietly ctest --preset asan-ubsan -R '^(base|network)\.'
}

# The lines of README.md's ```sh blocks that call this repository's scripts or the program.
readme_commands() {
  sed -n '/^```sh$/,/^```$/p' README.md | grep -E '^(\./|assay )' | grep -vE '^\./test\.sh|^\.ci/'
}

test_readme_commands() {
  local command
  while read -r command; do
    echo "README: $command" >&2
    PATH="$root/build/release/bin:$PATH" quietly bash -euo pipefail -c "$command"
  done < <(readme_commands)
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
