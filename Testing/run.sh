#!/usr/bin/env bash
# Installs what is missing, builds everything and passes every test, some of the solver's with the
# address and undefined-behaviour sanitizers as well.
set -euo pipefail
cd "$(dirname "$0")/.."
. .ci/setup.sh
smokevisibility_build
smokevisibility_say "Testing"
# Most tests keep one core busy.
ctest --preset release --parallel 2
smokevisibility_make asan-quick StressTests
smokevisibility_say "Testing with sanitizers"
ctest --preset asan-quick --parallel 2 --label-regex EveryChange
