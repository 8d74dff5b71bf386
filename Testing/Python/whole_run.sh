#!/usr/bin/env bash
# Data/Scripts/whole_run.py: killed and begun again on two processes, it gives the maps that one gives in one go.
# Usage: whole_run.sh MPIEXEC PVBATCH PLUGIN DATA_FOLDER
set -euo pipefail
mpiexec=$1 pvbatch=$2 plugin=$3 script=$4/Scripts/whole_run.py
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
. "$(dirname "$0")/processes.sh"
options+=(--bind-to none)
run()
{
  timeout 250 "$mpiexec" "${options[@]}" -np "$1" "$pvbatch" --force-offscreen-rendering "$script" "$plugin" \
    "$work/$2" quick
}

run 1 one
run 2 two >"$work/killed.txt" 2>&1 &
job=$!
for _ in $(seq 1000); do
  ls "$work"/two/map_*.vti >/dev/null 2>&1 && break
  sleep 0.1
done
# timeout passes the signal on to mpiexec, which ends its processes.
kill -TERM "$(pgrep -P "$job")" || true
wait "$job" || true
run 2 two | tee "$work/again.txt"
grep -q ": kept" "$work/again.txt"

"$(dirname "$pvbatch")/pvpython" - "$work" <<'PYTHON'
import glob
import os
import sys

from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLImageDataReader


def arrays(path):
    reader = vtkXMLImageDataReader()
    reader.SetFileName(path)
    reader.Update()
    points = reader.GetOutput().GetPointData()
    return {points.GetArrayName(i): vtk_to_numpy(points.GetArray(i)).tobytes()
            for i in range(points.GetNumberOfArrays())}


one = sorted(glob.glob(os.path.join(sys.argv[1], "one", "*")))
assert [os.path.basename(path) for path in one] == sorted(os.listdir(os.path.join(sys.argv[1], "two")))
assert len(one) == 2, one
for path in one:
    expected = arrays(path)
    assert len(expected) == 13, expected.keys()
    assert arrays(path.replace("/one/", "/two/")) == expected, path
print("The same maps, killed and resumed or not.")
PYTHON
