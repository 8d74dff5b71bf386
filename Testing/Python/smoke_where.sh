#!/usr/bin/env bash
# Draws smoke with 1 and 2 processes, and with a server of 2 there and here: the same picture.
# Usage: smoke_where.sh MPIEXEC PVBATCH PLUGIN DATA_FOLDER WORK_FOLDER; needs a display.
set -euo pipefail
mpiexec=$1 pvbatch=$2 plugin=$3 data=$4 work=$5
script=$(dirname "$0")/smoke_where.py
programs=$(dirname "$pvbatch")
picture=$work/smoke_where.npy
options=(--oversubscribe)
if [ "$(id -u)" -eq 0 ]; then
  options+=(--allow-run-as-root)
fi
rm -f "$picture"
timeout 60 "$programs/pvpython" --dr --force-offscreen-rendering "$script" "$plugin" "$data" "$picture"
timeout 60 "$mpiexec" "${options[@]}" -np 2 "$pvbatch" --symmetric --dr --force-offscreen-rendering \
  "$script" "$plugin" "$data" "$picture"
for where in remote local; do
  port=$((20000 + ($$ + ${#where}) % 20000))
  timeout 120 "$mpiexec" "${options[@]}" -np 2 "$programs/pvserver" --force-offscreen-rendering \
    --server-port="$port" >"$work/smoke_server.txt" 2>&1 &
  server=$!
  for _ in $(seq 100); do
    grep -q "Accepting connection" "$work/smoke_server.txt" && break
    sleep 0.2
  done
  timeout 100 "$programs/pvpython" --dr --force-offscreen-rendering "$script" "$plugin" "$data" \
    "$picture" "$port" "$where"
  wait "$server" || true
  if grep "ERR|" "$work/smoke_server.txt"; then
    exit 1
  fi
done
echo "The same picture from one process, from two, from a server of two and on its client."
