#!/usr/bin/env bash
# Fails when a layer includes what lies above it, or Embree outside the one place that knows it.
set -uo pipefail
cd "$(dirname "$0")/.."
failed=0
report()
{
  if [ -n "$2" ]; then
    printf '%s:\n%s\n' "$1" "$2"
    failed=1
  fi
}
report "VTK or ParaView headers below the VTK layer" \
  "$(grep -rnE '#include *[<"](vtk|pq)' Filters/Radiance Readers/Formats Readers/CAD)"
report "Embree outside Filters/Radiance/Geometry" \
  "$(grep -rnE 'embree[34]/|\brtc[A-Z]' Filters Readers Plugin --include='*.h' --include='*.cxx' |
    grep -vE '^Filters/Radiance/Geometry\.(h|cxx):')"
report "CAD libraries outside Readers/CAD" \
  "$(grep -rnE '#include *[<"](assimp/|(BRep|XCAF|STEP|IGES|TopoDS|Message_))' \
    Filters Readers Plugin --include='*.h' --include='*.cxx' |
    grep -vE '^Readers/CAD/')"
report "The solver knows of file formats, or the file formats of the solver's scene" \
  "$(grep -rnE '#include "(SmvFile|SliceFile)' Filters/Radiance
    grep -rnE '#include "(Scene|LightField|View)\.h"' Readers/Formats)"
[ "$failed" -eq 0 ] && echo "The layers are clean."
exit "$failed"
