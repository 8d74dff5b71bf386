# Sourced by the two commands: installs the packages that are missing, configures and builds.
# Usage: . .ci/setup.sh; smokevisibility_build [target...]

smokevisibility_packages=(
  cmake g++ clang ninja-build git
  paraview paraview-dev python3-paraview python3-numpy python3-scipy python3-matplotlib
  qtbase5-dev qttools5-dev libqt5svg5-dev libqt5x11extras5-dev libqt5opengl5-dev
  qtxmlpatterns5-dev-tools libutfcpp-dev python3-dev python3-mpi4py libopenmpi-dev openmpi-bin libxml2-dev
  libhdf5-dev libhdf5-openmpi-dev libnetcdf-dev libgdal-dev libcgns-dev libboost-dev libtheora-dev
  libogg-dev libavcodec-dev libavformat-dev libavutil-dev libswscale-dev libexpat1-dev liblzma-dev
  liblz4-dev libdouble-conversion-dev libjpeg-dev libtiff-dev libpng-dev libfreetype-dev
  libgl2ps-dev libglew-dev libglvnd-dev libjsoncpp-dev libproj-dev libpugixml-dev libsqlite3-dev
  libeigen3-dev libxt-dev nlohmann-json3-dev protobuf-compiler libprotobuf-dev libfmt-dev zlib1g-dev
  libembree-dev libglm-dev libopenexr-dev python3-imath libtbb-dev libgtest-dev libgmock-dev
  libassimp-dev libocct-data-exchange-dev
  xvfb xauth imagemagick)

smokevisibility_say()
{
  printf '\n== %s\n' "$*"
}

smokevisibility_install()
{
  local missing=()
  local package
  for package in "${smokevisibility_packages[@]}"; do
    if ! dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'ok installed'; then
      missing+=("$package")
    fi
  done
  if [ ${#missing[@]} -eq 0 ]; then
    return
  fi
  smokevisibility_say "Installing ${#missing[@]} packages: ${missing[*]}"
  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    as_root=(sudo)
  fi
  "${as_root[@]}" apt-get update -qq
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
}

# Configures and builds a preset in its folder below build, below the repository's root.
# Usage: smokevisibility_make preset [target...]
smokevisibility_make()
{
  smokevisibility_say "Configuring and building in build/$1"
  cmake --preset "$1" >build-configure.log 2>&1 || { cat build-configure.log; return 1; }
  rm -f build-configure.log
  cmake --build --preset "$1" ${2:+--target "${@:2}"}
}

# Sets SMOKEVISIBILITY_BUILD.
smokevisibility_build()
{
  smokevisibility_install
  SMOKEVISIBILITY_BUILD="$PWD/build/release"
  smokevisibility_make release "$@"
}
