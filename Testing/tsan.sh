#!/bin/bash
# The solver and the filters under the thread sanitizer: bash Testing/tsan.sh [options of ctest]
#
# Debian's TBB is not built with the sanitizer, which then does not see how work is handed from thread
# to thread and takes each hand-over for a race. So Debian's source of the same version is fetched and
# built with it, below build/tsan-tbb, and loaded in place of the other by the test preset.
set -e
cd "$(dirname "${BASH_SOURCE[0]}")/.."
tbb="$PWD/build/tsan-tbb"

if [ ! -e "$tbb/lib/libtbb.so.12" ]; then
  rm -rf "$tbb"
  mkdir -p "$tbb/lists/partial" "$tbb/sources.list.d" "$tbb/lib"
  # Sources come from where the machine's packages do.
  for list in /etc/apt/sources.list /etc/apt/sources.list.d/*.list; do
    [ ! -e "$list" ] || sed -n 's/^deb[[:space:]]/deb-src /p' "$list" >> "$tbb/sources.list.d/packages.list"
  done
  for list in /etc/apt/sources.list.d/*.sources; do
    [ ! -e "$list" ] || sed 's/^Types:.*/Types: deb-src/' "$list" > "$tbb/sources.list.d/${list##*/}"
  done
  # The machine's own lists of packages stay as they are.
  apt=(apt-get -o Dir::Etc::SourceList=/dev/null -o "Dir::Etc::SourceParts=$tbb/sources.list.d"
    -o "Dir::State::Lists=$tbb/lists" -o "Dir::Cache=$tbb" -o APT::Sandbox::User=)
  "${apt[@]}" update
  (
    cd "$tbb"
    "${apt[@]}" source --download-only "onetbb=$(dpkg-query -W -f '${source:Version}' libtbb12)"
    mkdir source
    tar xf onetbb_*.orig.tar.* -C source --strip-components 1
  )
  cmake -S "$tbb/source" -B "$tbb/build" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo \
    -DTBB_SANITIZE=thread -DTBB_STRICT=OFF -DTBB_TEST=OFF -DTBBMALLOC_BUILD=OFF
  cmake --build "$tbb/build" --target tbb
  cp -P "$tbb"/build/*_relwithdebinfo/libtbb.so* "$tbb/lib"
fi

cmake --preset tsan
cmake --build --preset tsan --target RadianceTests VtkTests StressTests ValidationTests
ctest --preset tsan -R '^(RadianceTests|VtkTests|StressTests|ValidationTests)$' "$@"
