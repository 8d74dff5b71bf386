// What the FDS index (CHID.smv) says: meshes, obstructions, vents, surfaces, and the files there
// are.
#pragma once

#include "FolderNames.h"

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace smokevis
{

/// Node or cell index range i1 i2 j1 j2 k1 k2, node-based: cells i1 to i2 - 1 counted from 0.
using IndexRange = std::array<int, 6>;

/// A boundary surface (SURF line of the FDS input).
struct SmvSurface
{
  std::string Name;
  int Type = 0;
  /// Red, green, blue (sRGB) and alpha (1: opaque), each 0 to 1.
  std::array<double, 4> Color{1.0, 0.8, 0.4, 1.0};
  /// Image file that Smokeview puts on it; empty for none.
  std::string Texture;
};

/// A change of an obstruction or vent while the run goes.
struct SmvEvent
{
  /// Seconds of simulation.
  double Time = 0.0;
  /// Shown (obstruction) or open (vent) from then on.
  bool On = true;
};

/// Whether something with these events, in the order of their times, is on at @p time [s]. Before
/// its first event it is the opposite of what that event makes it; without events it is on.
bool IsOn(const std::vector<SmvEvent>& events, double time);

/// A block or a plate (two equal indices) of solid.
struct SmvObstruction
{
  std::string Name;
  IndexRange Range{};
  /// Surface on the sides facing -x, +x, -y, +y, -z, +z; index into SmvFile::Surfaces.
  std::array<int, 6> Surfaces{};
  /// The obstruction's own sRGB colour and alpha where it has one.
  std::optional<std::array<double, 4>> Color;
  /// Hidden in Smokeview by its author (COLOR='INVISIBLE').
  bool Invisible = false;
  std::vector<SmvEvent> Events;
};

/// A patch of other surface on a solid or on the outer boundary, or an opening in that boundary.
struct SmvVent
{
  IndexRange Range{};
  int Surface = 0;
  /// Direction into the gas, -3 to 3, along x (1), y (2) or z (3); 0 where the index does not say.
  int Orientation = 0;
  std::optional<std::array<double, 4>> Color;
  /// Centre x, y, z and radius [m] of a circular vent.
  std::optional<std::array<double, 4>> Circle;
  std::vector<SmvEvent> Events;
};

/// One rectilinear mesh.
struct SmvMesh
{
  std::string Name;
  /// Node coordinates along x, y, z [m], strictly increasing.
  std::array<std::vector<double>, 3> Nodes;
  std::vector<SmvObstruction> Obstructions;
  std::vector<SmvVent> Vents;

  int Cells(int axis) const { return static_cast<int>(Nodes[axis].size()) - 1; }
};

/// A quantity written to a file: what it is called there.
struct SmvQuantity
{
  std::string LongLabel;
  std::string ShortLabel;
  std::string Unit;
};

/// One slice file (.sf).
struct SmvSlice
{
  int Mesh = 0;
  bool CellCentred = false;
  IndexRange Range{};
  std::string File;
  SmvQuantity Quantity;

  bool IsVolume() const
  {
    return Range[0] < Range[1] && Range[2] < Range[3] && Range[4] < Range[5];
  }
};

/// One 3-D smoke file (.s3d).
struct SmvSmoke3D
{
  int Mesh = 0;
  /// Mass extinction coefficient Km [m2/kg]; 0 for quantities that are not smoke.
  double MassExtinction = 0.0;
  /// Whether the index says so; FDS's default is taken where it does not.
  bool StatesMassExtinction = false;
  std::string File;
  SmvQuantity Quantity;
};

/// One Plot3D file (.q): five quantities at one time.
struct SmvPlot3D
{
  int Mesh = 0;
  double Time = 0.0;
  std::string File;
  std::array<SmvQuantity, 5> Quantities;
};

/// One boundary file (.bf): a quantity on the walls of a mesh.
struct SmvBoundary
{
  int Mesh = 0;
  bool CellCentred = false;
  std::string File;
  SmvQuantity Quantity;
};

/// One file of complex geometry: solids (.ge) or the faces that they cut out of cells (.gcf).
struct SmvGeometry
{
  bool CutFaces = false;
  std::string File;
};

/// A measuring point (DEVC line).
struct SmvDevice
{
  std::string Name;
  std::string Quantity;
  /// [m]; not numbers where they did not fit into the index.
  std::array<double, 3> Position{};
};

/// The index of an FDS run, read and checked.
class SmvFile
{
public:
  /// Reads @p path. Throws Error when it is unreadable, empty, not an FDS index, or inconsistent.
  explicit SmvFile(const std::string& path);

  /// The path of a file that the index names: beside the index; backslashes of Windows understood.
  /// Where there is none so called, the only one that differs in capital and small letters alone.
  std::string Resolve(const std::string& name) const;

  /// The surface that FDS gives to boundaries without a vent.
  int DefaultSurface() const;

  std::string Path;
  std::string Chid;
  std::string Title;
  std::string Version;
  /// Begin and end of the run [s].
  std::array<double, 2> Times{0.0, 0.0};
  /// Single-scattering albedo of the smoke; FDS writes its default, 0.3, unless told otherwise.
  std::optional<double> Albedo;
  /// Scales of the 8-bit flame files: heat release rate [kW/m3] and temperature [C].
  std::array<double, 2> HeatReleaseRange{0.0, 1200.0};
  std::array<double, 2> TemperatureRange{20.0, 2000.0};
  std::string DefaultSurfaceName;
  std::vector<SmvSurface> Surfaces;
  std::vector<SmvMesh> Meshes;
  std::vector<SmvSlice> Slices;
  std::vector<SmvSmoke3D> Smoke3D;
  std::vector<SmvPlot3D> Plot3D;
  std::vector<SmvBoundary> Boundaries;
  std::vector<SmvGeometry> Geometries;
  std::vector<SmvDevice> Devices;
  /// Text tables (type such as `devc` or `hrr`, and file name).
  std::vector<std::pair<std::string, std::string>> Tables;
  /// What a reader should know but can live with, e.g. an index that ends in the middle of an
  /// entry.
  std::vector<std::string> Warnings;

private:
  std::shared_ptr<const FolderNames> names_ = std::make_shared<FolderNames>();
};

} // namespace smokevis
