#!/usr/bin/env bash
# Installs what is missing, builds, and runs assay with the given arguments.
#   ./run.sh                     figure 13 of Spar, with pictures of every step in out/fig13
#   ./run.sh VERB ...            assay VERB ...
#   ./run.sh --install [PREFIX]  puts assay, its models, scenarios and completions into PREFIX, which
#                                is /usr/local for root and ~/.local for everybody else
set -euo pipefail
root=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
source "$root/.ci/setup"
program=$root/build/release/bin/assay
first_build="the first build takes 5 to 8 minutes on two cores"

usage() { sed -n '2,/^[^#]/s/^# \?//p' "$root/run.sh"; }
verbs() { sed -n 's/^ *\.name = "\(.*\)",$/\1/p' "$root"/sim/cli/*/*.cc; }

# Answers requests at once that do not need an up-to-date program.
answer_at_once() {
  case ${1-} in
    --help | -h | --version)
      [ ! -x "$program" ] || exec "$program" "$@"
      [ "$1" = --version ] && sed -n 's/^project(assay VERSION \([0-9.]*\).*/assay \1/p' \
        "$root/CMakeLists.txt" || usage
      echo "Nothing is built yet: $first_build."
      exit 0
      ;;
  esac
  if ! verbs | grep -qxF -e "$1"; then
    [ ! -x "$program" ] || exec "$program" "$@"
    echo "assay: there is no verb '$1'; allowed: $(verbs | sort | paste -sd ' ')" >&2
    exit 2
  fi
  if [[ " $* " == *" --help "* && -x $program ]]; then exec "$program" "$@"; fi
}

build_program() {
  install_missing_packages program
  # A build folder that is configured with tests and benchmarks stays so.
  [ -e "$root/build/release/CMakeCache.txt" ] ||
    configure release -DASSAY_TESTS=OFF -DASSAY_BENCH=OFF
  [ -x "$program" ] || echo "Building assay: $first_build" >&2
  build release assay
}

install_program() {
  local prefix=${1-}
  [ -n "$prefix" ] || if [ "$(id -u)" -eq 0 ]; then prefix=/usr/local; else prefix=$HOME/.local; fi
  build_program
  cmake --install "$root/build/release" --prefix "$prefix" --component program >/dev/null
  echo "Installed $prefix/bin/assay"
  [[ ":$PATH:" == *":$prefix/bin:"* ]] || echo "Not on the PATH yet: export PATH=\"$prefix/bin:\$PATH\""
}

if [ "${1-}" = --install ]; then
  install_program "${@:2}"
  exit
fi
[ $# -eq 0 ] || answer_at_once "$@"
build_program
if [ $# -eq 0 ]; then
  cd "$root"
  set -- run scenarios/spar-fig13.yaml --renders -o out/fig13
fi
exec "$program" "$@"
