#!/usr/bin/env bash
# Builds SmokeVisibility and holds it against what Zhang and Rubini report of their smoke tunnel.
# Everything it makes lands in build/tunnel; README.md beside this file says what is what.
set -euo pipefail
cd "$(dirname "$0")/../.."
. .ci/setup.sh
smokevisibility_build

output="$PWD/build/tunnel"
plugin="$SMOKEVISIBILITY_BUILD/lib/SmokeVisibility/SmokeVisibility.so"
mkdir -p "$output"

smokevisibility_say "Computing the tunnel, claim by claim"
pvpython --force-offscreen-rendering Data/Tunnel/table.py "$plugin" "$output" | tee "$output/summary.txt"
