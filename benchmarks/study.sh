# SPDX-License-Identifier: MIT
# Functions shared by the scripts benchmarks/NAME/run.
root=$(cd "$(dirname "$0")/../.." && pwd)

# build_study NAME [PACKAGE...]: installs what is missing (Debian, Ubuntu) and builds the program for this machine; also
# the targets of tests that $also lists.
build_study() {
  study=$1
  shift
  # Only the program may write to standard output.
  sh "$root/cmake/install-packages.sh" g++ cmake ninja-build pkg-config libeigen3-dev libnanoflann-dev libcli11-dev \
    libcairo2-dev "$@" >&2
  build="$root/build/$study"
  tests=OFF
  [ -z "${also:-}" ] || tests=ON
  cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DHMPS_NATIVE=ON -DHMPS_BUILD_TESTS=$tests >&2
  cmake --build "$build" --target "$study" ${also:-} --parallel "$(nproc)" >&2
}

# writes_page ARGUMENT...: succeeds if a run with these arguments of the user should write the page.
writes_page() {
  for argument in "$@"; do
    case "$argument" in --quick | --list | -h | --help | --out | --out=*) return 1 ;; esac
  done
}

# run_study ARGUMENT...: runs the program that was built, which writes docs/measured/NAME.md with its pictures, and its
# tables to results/NAME. With --quick (tables in results/NAME_quick), --list, --help or the user's own --out, the page
# is not changed.
run_study() {
  program="$build/benchmarks/$study/$study"
  if writes_page "$@"; then
    exec "$program" --out "$root/results/$study" --document "$root/docs/measured/$study.md" "$@"
  fi
  exec "$program" --out "$root/results/${study}_quick" "$@"
}
