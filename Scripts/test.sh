#!/usr/bin/env bash
# Builds Sinew and runs every test; then builds with asserts, AddressSanitizer and UndefinedBehaviorSanitizer and runs
# the unit tests again. Fails when any of it fails.
set -euo pipefail
source "$(dirname -- "${BASH_SOURCE[0]}")/common.sh"
cd -- "$repository"
jobs=$(compilers)
closing=()  # the last lines of every ctest run

# run_tests PRESET ctest-options...
run_tests() {
  local log=build/$1/ctest.log
  ctest --preset "$1" --parallel "$jobs" "${@:2}" 2>&1 | tee "$log"
  closing+=("$(printf '%s: ' "$1"; grep -A 99 -E '^[0-9]+% tests passed' "$log")")
}

say "Packages"
Scripts/install-dependencies.sh --testing

say "Release: build"
cmake --preset release "${at_once[@]}" -D SINEW_BUILD_TESTING=ON
cmake --build --preset release --parallel "$jobs"

say "Release: all tests"
run_tests release

say "Asserts and sanitizers: build"
cmake --preset dev "${at_once[@]}"
cmake --build --preset dev --parallel "$jobs" --target unit-tests

say "Asserts and sanitizers: unit tests"
run_tests dev --label-regex unit

say "All tests passed in $((SECONDS / 60)) min $((SECONDS % 60)) s"
printf '\n%s\n' "${closing[@]}"
