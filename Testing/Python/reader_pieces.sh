#!/usr/bin/env bash
# Runs reader_pieces.py with 1, 2 and 3 processes and compares what they read.
# Usage: reader_pieces.sh MPIEXEC PVBATCH PLUGIN DATA_FOLDER WORK_FOLDER
set -euo pipefail
mpiexec=$1 pvbatch=$2 plugin=$3 data=$4 work=$5
. "$(dirname "$0")/processes.sh"
for processes in 1 2 3; do
  timeout 180 "$mpiexec" "${options[@]}" -np "$processes" "$pvbatch" --symmetric \
    --force-offscreen-rendering "$(dirname "$0")/reader_pieces.py" "$plugin" "$data" \
    "$work/pieces$processes.txt"
  cmp "$work/pieces1.txt" "$work/pieces$processes.txt"
done
echo "The same bits with 1, 2 and 3 processes."
