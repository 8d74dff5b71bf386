// The index's entries, one function a kind of entry.
#include "PrintableText.h"
#include "SmvFile.h"
#include "SmvParser.h"
#include "TextFields.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace smokevis
{

namespace
{

// A number of the index as an integer; what no integer holds becomes -1, which no check lets pass.
int ToInteger(double number)
{
  return std::abs(number) <= std::numeric_limits<int>::max() ? static_cast<int>(number) : -1;
}

} // namespace

//------------------------------------------------------------------------------------------------
void SmvParser::ParseSurface()
{
  SmvSurface surface;
  surface.Name = this->NextLabel();
  this->Next(); // ignition temperature and emissivity
  const auto numbers = this->NextNumbers(7, "type, texture size, colour");
  surface.Type = ToInteger(numbers[0]);
  for (int i = 0; i < 4; ++i)
  {
    surface.Color[i] = std::clamp(numbers[3 + i], 0.0, 1.0);
  }
  const std::string texture = this->NextText();
  surface.Texture = texture == "null" ? std::string() : texture;
  index_.Surfaces.push_back(std::move(surface));
}

//------------------------------------------------------------------------------------------------
void SmvParser::ParseGrid(std::string_view line)
{
  const std::vector<int> counts = SplitIntegers(this->Next(), 3, 6);
  if (counts.size() < 3 || *std::min_element(counts.begin(), counts.end()) < 1)
  {
    this->Fail("a mesh needs three positive cell counts");
  }
  const double product = 1.0 * counts[0] * counts[1] * counts[2];
  if (product > std::numeric_limits<int>::max())
  {
    this->Fail("a mesh has more cells than FDS can count");
  }
  std::copy(counts.begin(), counts.end(), cells_.begin());
  index_.Meshes.emplace_back();
  index_.Meshes.back().Name =
    line.empty() ? "mesh " + std::to_string(index_.Meshes.size()) : Printable(line);
}

//------------------------------------------------------------------------------------------------
void SmvParser::ParseNodes(int axis)
{
  if (index_.Meshes.empty())
  {
    this->Fail("node coordinates come before any mesh (GRID)");
  }
  const int skip = this->NextCount("stretching lines", 1);
  line_ += static_cast<std::size_t>(skip);
  const auto count = static_cast<std::size_t>(cells_[axis]) + 1;
  if (count > lines_.size() - line_)
  {
    throw EndOfIndex();
  }
  if (!index_.Meshes.back().Nodes[axis].empty())
  {
    this->Fail("mesh '" + index_.Meshes.back().Name + "' has its node coordinates twice");
  }
  // Filled aside: the lines may end in the middle.
  std::vector<double> nodes;
  nodes.reserve(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    const auto numbers = this->NextNumbers(2, "node number and coordinate");
    if (!nodes.empty() && !(numbers[1] > nodes.back()))
    {
      this->Fail(
        "the node coordinates of mesh '" + index_.Meshes.back().Name + "' do not increase");
    }
    nodes.push_back(numbers[1]);
  }
  index_.Meshes.back().Nodes[axis] = std::move(nodes);
}

//------------------------------------------------------------------------------------------------
std::array<int, 6> SmvParser::CheckedRange(
  const std::vector<double>& numbers, int mesh, const char* what) const
{
  IndexRange range{};
  for (int i = 0; i < 6; ++i)
  {
    const double most = index_.Meshes[mesh].Cells(i / 2);
    if (numbers[i] < 0 || numbers[i] > most || (i % 2 == 1 && numbers[i] < numbers[i - 1]))
    {
      this->Fail(std::string(what) + " has an index range outside of mesh '" +
                 index_.Meshes[mesh].Name + "'");
    }
    range[i] = static_cast<int>(numbers[i]);
  }
  return range;
}

//------------------------------------------------------------------------------------------------
void SmvParser::ParseObstructions()
{
  if (index_.Meshes.empty())
  {
    this->Fail("obstructions come before any mesh (GRID)");
  }
  SmvMesh& mesh = index_.Meshes.back();
  const int meshNumber = static_cast<int>(index_.Meshes.size()) - 1;
  const int count = this->NextCount("obstructions", 2);
  // Filled aside, too.
  std::vector<SmvObstruction> obstructions(static_cast<std::size_t>(count));
  for (SmvObstruction& obstruction : obstructions)
  {
    const auto numbers = SplitNumbers(Before(lines_[line_], '!'));
    obstruction.Name = Printable(Trim(After(this->Next(), '!')));
    if (numbers.size() < 13)
    {
      this->Fail("an obstruction needs six bounds, a number and six surfaces");
    }
    for (int side = 0; side < 6; ++side)
    {
      obstruction.Surfaces[side] = ToInteger(numbers[7 + side]);
    }
  }
  for (SmvObstruction& obstruction : obstructions)
  {
    const std::string_view line = Before(this->Next(), '!');
    const auto indices = SplitIntegers(line, 8, 5);
    const auto numbers = SplitNumbers(line);
    if (indices.size() < 8)
    {
      this->Fail("an obstruction needs six indices, colour and type");
    }
    obstruction.Range =
      this->CheckedRange({indices.begin(), indices.end()}, meshNumber, "an obstruction");
    const int colour = indices[6];
    obstruction.Invisible = colour == -2;
    if (colour == -3)
    {
      if (numbers.size() < 12)
      {
        this->Fail("an obstruction with its own colour needs red, green, blue and alpha");
      }
      obstruction.Color.emplace();
      std::transform(numbers.end() - 4, numbers.end(), obstruction.Color->begin(),
        [](double part) { return std::clamp(part, 0.0, 1.0); });
    }
  }
  mesh.Obstructions = std::move(obstructions);
}

//------------------------------------------------------------------------------------------------
void SmvParser::ParseVents(bool circular)
{
  if (index_.Meshes.empty())
  {
    this->Fail("vents come before any mesh (GRID)");
  }
  SmvMesh& mesh = index_.Meshes.back();
  const int meshNumber = static_cast<int>(index_.Meshes.size()) - 1;
  const auto count = static_cast<std::size_t>(this->NextCount("vents", 2));
  std::vector<SmvVent> vents(count);
  for (SmvVent& vent : vents)
  {
    const std::string_view line = this->Next();
    const auto numbers = SplitNumbers(Before(Before(line, '!'), '%'));
    if (numbers.size() < 8)
    {
      this->Fail("a vent needs six bounds, a number and a surface");
    }
    vent.Surface = ToInteger(numbers[7]);
    if (circular)
    {
      const auto circle = SplitNumbers(After(line, '%'));
      if (circle.size() < 4)
      {
        this->Fail("a circular vent needs its centre and radius");
      }
      vent.Circle = {circle[0], circle[1], circle[2], circle[3]};
    }
  }
  for (SmvVent& vent : vents)
  {
    const std::string_view line = this->Next();
    const std::string_view fields = Before(line, '!');
    const auto indices = SplitIntegers(fields, 8, 5);
    const auto numbers = SplitNumbers(fields);
    if (indices.size() < 8)
    {
      this->Fail("a vent needs six indices, colour and type");
    }
    vent.Range = this->CheckedRange({indices.begin(), indices.end()}, meshNumber, "a vent");
    if (numbers.size() >= 12)
    {
      vent.Color.emplace();
      std::transform(numbers.end() - 4, numbers.end(), vent.Color->begin(),
        [](double part) { return std::clamp(part, 0.0, 1.0); });
    }
    const auto orientation = SplitIntegers(After(line, '!'), 1, 6);
    vent.Orientation = orientation.empty() ? 0 : orientation[0];
  }
  mesh.Vents.insert(mesh.Vents.end(), vents.begin(), vents.end());
}

//------------------------------------------------------------------------------------------------
void SmvParser::ParseSlice(std::string_view line, bool cellCentred)
{
  // mesh # TYPE [% ID] & i1 i2 j1 j2 k1 k2 ! index cell_centred IOR; the ID is the analyst's and
  // may have marks of its own.
  const auto mesh = SplitIntegers(line, 1, 6);
  const auto range = SplitIntegers(Before(AroundLast(line, '&').second, '!'), 6, 6);
  if (mesh.empty() || range.size() < 6)
  {
    this->Fail("a slice needs its mesh number and six indices");
  }
  SmvSlice slice;
  slice.Mesh = this->MeshNumber(mesh[0], "a slice");
  slice.CellCentred = cellCentred;
  slice.Range = this->CheckedRange({range.begin(), range.end()}, slice.Mesh, "a slice");
  slice.File = this->NextText();
  slice.Quantity = this->NextQuantity();
  index_.Slices.push_back(std::move(slice));
}

//------------------------------------------------------------------------------------------------
void SmvParser::ParseSmoke3D(std::string_view line)
{
  const auto numbers = SplitNumbers(line);
  if (numbers.empty())
  {
    this->Fail("a 3-D smoke file needs its mesh number");
  }
  SmvSmoke3D smoke;
  smoke.Mesh = this->MeshNumber(ToInteger(numbers[0]), "a 3-D smoke file");
  smoke.File = this->NextText();
  smoke.Quantity = this->NextQuantity();
  // Before FDS 6.7.9 the index did not say Km; soot had FDS's default.
  const bool soot = smoke.Quantity.LongLabel.find("SOOT") != std::string::npos;
  smoke.StatesMassExtinction = numbers.size() > 1;
  smoke.MassExtinction = smoke.StatesMassExtinction ? numbers[1] : (soot ? 8700.0 : 0.0);
  index_.Smoke3D.push_back(std::move(smoke));
}

//------------------------------------------------------------------------------------------------
void SmvParser::ParsePlot3D(std::string_view line)
{
  const auto numbers = SplitNumbers(line);
  if (numbers.size() < 2)
  {
    this->Fail("a Plot3D file needs its time and mesh number");
  }
  SmvPlot3D plot;
  plot.Time = numbers[0];
  plot.Mesh = this->MeshNumber(ToInteger(numbers[1]), "a Plot3D file");
  plot.File = this->NextText();
  for (SmvQuantity& quantity : plot.Quantities)
  {
    quantity = this->NextQuantity();
  }
  index_.Plot3D.push_back(std::move(plot));
}

//------------------------------------------------------------------------------------------------
void SmvParser::ParseBoundary(std::string_view line, bool cellCentred)
{
  const auto mesh = SplitIntegers(line, 1, 6);
  if (mesh.empty())
  {
    this->Fail("a boundary file needs its mesh number");
  }
  SmvBoundary boundary;
  boundary.Mesh = this->MeshNumber(mesh[0], "a boundary file");
  boundary.CellCentred = cellCentred;
  boundary.File = this->NextText();
  boundary.Quantity = this->NextQuantity();
  index_.Boundaries.push_back(std::move(boundary));
}

//------------------------------------------------------------------------------------------------
void SmvParser::ParseDevice()
{
  SmvDevice device;
  // The name may have marks of its own, as in "door 50% open % TEMPERATURE".
  const auto [name, quantity] = AroundLast(this->Next(), '%');
  device.Name = Printable(Trim(name));
  device.Quantity = Printable(Trim(quantity));
  // Fortran writes asterisks for numbers that are wider than their field, as map coordinates are.
  const std::string_view place = this->Next();
  const auto numbers = SplitNumbers(place);
  if (numbers.size() >= 3)
  {
    std::copy_n(numbers.begin(), 3, device.Position.begin());
  }
  else if (place.find('*') != std::string_view::npos)
  {
    device.Position.fill(std::numeric_limits<double>::quiet_NaN());
  }
  else
  {
    this->Fail("expected 3 numbers (device position)");
  }
  index_.Devices.push_back(std::move(device));
}

//------------------------------------------------------------------------------------------------
void SmvParser::ParseEvent(std::string_view line, bool obstruction, bool on)
{
  const auto meshNumber = SplitIntegers(line, 1, 6);
  const auto numbers = this->NextNumbers(2, "number and time of the change");
  if (meshNumber.empty())
  {
    this->Fail("a change of an obstruction or vent needs its mesh number");
  }
  const std::string thing = obstruction ? "obstruction " : "vent ";
  const auto meshes = static_cast<int>(index_.Meshes.size());
  if (meshNumber[0] < 1 || meshNumber[0] > meshes)
  {
    this->LeaveOutChange("a change of " + thing + "names mesh " + std::to_string(meshNumber[0]) +
                         " of " + std::to_string(meshes));
    return;
  }
  SmvMesh& mesh = index_.Meshes[meshNumber[0] - 1];
  const std::size_t size = obstruction ? mesh.Obstructions.size() : mesh.Vents.size();
  const int number = ToInteger(numbers[0]);
  if (number < 1 || static_cast<std::size_t>(number) > size || !std::isfinite(numbers[1]))
  {
    this->LeaveOutChange("a change names " + thing + std::to_string(number) + " of mesh '" +
                         mesh.Name + "', which has " + std::to_string(size));
    return;
  }
  const auto place = static_cast<std::size_t>(number) - 1;
  std::vector<SmvEvent>& events =
    obstruction ? mesh.Obstructions[place].Events : mesh.Vents[place].Events;
  // A restarted run may write a change again, out of order.
  const SmvEvent event{numbers[1], on};
  events.insert(std::upper_bound(events.begin(), events.end(), event,
                  [](const SmvEvent& a, const SmvEvent& b) { return a.Time < b.Time; }),
    event);
}

//------------------------------------------------------------------------------------------------
void SmvParser::LeaveOutChange(const std::string& what)
{
  ++strangeChanges_;
  if (strangeChange_.empty())
  {
    strangeChange_ = index_.Path + ", line " + std::to_string(line_) + ": " + what;
  }
}

} // namespace smokevis
