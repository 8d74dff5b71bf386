#!/usr/bin/env bash
# Draws smoke with 1 and 2 processes, and with a server of 2 there and here: the same picture.
# Usage: smoke_where.sh MPIEXEC PVBATCH PLUGIN DATA_FOLDER WORK_FOLDER; needs a display.
set -euo pipefail
mpiexec=$1 pvbatch=$2 plugin=$3 data=$4 work=$5
script=$(dirname "$0")/smoke_where.py
picture=$work/smoke_where.npy
. "$(dirname "$0")/processes.sh"
rm -f "$picture"
timeout 60 "$programs/pvpython" --dr --force-offscreen-rendering "$script" "$plugin" "$data" "$picture"
timeout 60 "$mpiexec" "${options[@]}" -np 2 "$pvbatch" --symmetric --dr --force-offscreen-rendering \
  "$script" "$plugin" "$data" "$picture"
for where in remote local; do
  port=$((20000 + ($$ + ${#where}) % 20000))
  start_server "$port" "$work/smoke_server.txt"
  timeout 100 "$programs/pvpython" --dr --force-offscreen-rendering "$script" "$plugin" "$data" \
    "$picture" "$port" "$where"
  wait "$server" || true
  if grep "ERR|" "$work/smoke_server.txt"; then
    exit 1
  fi
done
echo "The same picture from one process, from two, from a server of two and on its client."
