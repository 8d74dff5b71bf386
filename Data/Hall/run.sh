#!/usr/bin/env bash
# Builds SmokeVisibility and lets it answer, for a hall on fire: from where can an exit sign be seen?
# Everything it makes lands in build/hall; README.md beside this file says what is what.
set -euo pipefail
cd "$(dirname "$0")/../.."
. .ci/setup.sh
smokevisibility_build

output="$PWD/build/hall"
plugin="$SMOKEVISIBILITY_BUILD/lib/SmokeVisibility/SmokeVisibility.so"
mkdir -p "$output"

# ParaView of Debian 12 draws through X only; the server is not to reset itself between connections.
on_screen=(xvfb-run -a -s "-noreset -screen 0 1280x1024x24")
smokevisibility_say "Computing the hall"
"${on_screen[@]}" pvpython --force-offscreen-rendering Data/Hall/hall.py "$plugin" "$output" | tee "$output/summary.txt"

smokevisibility_say "Opening the state file in a fresh process"
"${on_screen[@]}" pvpython --force-offscreen-rendering Data/Hall/check_state.py "$plugin" "$output"
