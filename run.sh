#!/usr/bin/env bash
# Installs what is missing, builds, and runs assay with the given arguments; without any, it runs
# the peg and the block of Spar's figure 13, with pictures of every step in out/fig13.
set -euo pipefail
root=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
source "$root/.ci/setup"

install_missing_packages
build release assay
if [ $# -eq 0 ]; then
  cd "$root"
  set -- run scenarios/spar-fig13.yaml --renders -o out/fig13
fi
exec "$root/build/release/bin/assay" "$@"
