#!/usr/bin/env bash
# Walks through the user guide in the real ParaView on a display that nobody sees: run.sh PLUGIN DATA_FOLDER MODULES FOLDER
# MODULES is where the Python package smokevisibility is; pictures go to FOLDER.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
plugin=$1 folder=$4
mkdir -p "$folder"
rm -f "$folder/passed" "$folder/failed"
home=$(mktemp -d)
trap 'rm -rf "$home"' EXIT
# A home of its own: settings of the user would change the pictures.
export HOME=$home XDG_RUNTIME_DIR=$home QT_LOGGING_RULES="*=false"
export SMOKEVISIBILITY_DATA=$2 PYTHONPATH=$3 SMOKEVISIBILITY_WALK=$folder
PV_PLUGIN_PATH=$(dirname "$plugin") xvfb-run -a -s "-noreset -screen 0 1400x860x24" \
  paraview --dr --script="$here/walk.py" 2>&1 | tee "$folder/log.txt"
if [ ! -e "$folder/passed" ]; then
  echo "The walk did not reach its end."
  cat "$folder/failed" || true
  exit 1
fi
echo "The walk reached its end."
