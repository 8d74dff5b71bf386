#!/usr/bin/env bash
# Installs what is missing, builds everything and passes every test.
set -euo pipefail
cd "$(dirname "$0")/.."
. .ci/setup.sh
smokevisibility_build
smokevisibility_say "Testing"
# Most tests keep one core busy.
ctest --preset release --parallel 2
