#!/usr/bin/env bash
# Installs the build to a folder of its own and uses it from there: run.sh BUILD_FOLDER DATA_FOLDER PVPYTHON
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
build=$1
sample=$2/CAD/kiosk.obj
pvpython=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
prefix=$work/prefix
export PYTHONDONTWRITEBYTECODE=1

cmake --install "$build" --prefix "$prefix" >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
plugin=$(dirname "$(find "$prefix" -name SmokeVisibility.so)")
export PV_PLUGIN_PATH=$plugin
# Nothing may come from the build, neither by path nor by environment.
unset LD_LIBRARY_PATH
"$pvpython" --force-offscreen-rendering "$here/use_plugin.py" "$prefix" "$sample"

modules=$(dirname "$(find "$prefix" -type d -name smokevisibility -path '*dist-packages*')")
PYTHONPATH=$modules /usr/bin/python3 -c "
from smokevisibility.SmokeReaders import vtkCADReader
from smokevisibility.SmokeFilters import vtkExitSignSource
from smokevisibility.SmokeDisplay import vtkSmokeVolumeRepresentation
reader = vtkCADReader()
reader.SetFileName('$sample')
reader.Update()
assert reader.GetOutput().GetNumberOfCells() == 14
sign = vtkExitSignSource()
sign.Update()
assert sign.GetOutput().GetNumberOfCells() > 0
"

cat >"$work/shown.py" <<'PYTHON'
import os

from smokevisibility import display

assert os.path.isfile(display.COLOR_MAP), display.COLOR_MAP
PYTHON
PYTHONPATH=$modules "$pvpython" --force-offscreen-rendering "$work/shown.py"
test -e "$prefix/share/smokevisibility/Macros/show_map.py"

cmake -S "$here" -B "$work/consumer" -G Ninja -DCMAKE_PREFIX_PATH="$prefix" >"$work/log" 2>&1 &&
  cmake --build "$work/consumer" >>"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
"$pvpython" --force-offscreen-rendering "$here/use_plugin.py" "$prefix" "$sample" \
  "$(find "$work/consumer" -name Consumer.so)"
