#include "PhotometricFile.h"

#include "Errors.h"
#include "IntensityTable.h"
#include "TextFile.h"
#include "TextLines.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>

#include <glm/gtc/constants.hpp>

namespace smokevis
{

namespace
{

constexpr double Foot = 0.3048;
constexpr double SameAngle = 1e-3;
/// More intensities than any goniophotometer measures.
constexpr double MostValues = 1e6;

bool Same(double a, double b)
{
  return std::abs(a - b) < SameAngle;
}

/// A text's lines and, after the TILT line, its numbers.
class Scanner
{
public:
  Scanner(const std::string& text, std::string where)
      : Where_(std::move(where)), Lines_(SplitLines(text))
  {
  }

  bool AtEnd() const { return this->Line_ >= this->Lines_.size(); }
  const std::string& NextLine() { return this->Lines_[this->Line_++]; }

  [[noreturn]] void Fail(const std::string& what, const std::string& remedy) const
  {
    throw Error(this->Where_ + ", line " + std::to_string(std::max<std::size_t>(1, this->Last_)),
      what, remedy);
  }

  /// The next number, which a blank, a comma or a line's end separates from others.
  double Number(const std::string& name)
  {
    if (!this->FindToken())
    {
      this->Last_ = this->Lines_.size();
      this->Fail("the file ends before the " + name, "Get a complete file");
    }
    const std::string& line = this->Lines_[this->Line_];
    const std::size_t end = std::min(line.find_first_of(Blanks, this->Place_), line.size());
    const std::string_view token(line.data() + this->Place_, end - this->Place_);
    this->Last_ = this->Line_ + 1;
    this->Place_ = end;
    double value = 0.0;
    const char* const begin = token.data() + (token[0] == '+' ? 1 : 0);
    const auto [stop, code] = std::from_chars(begin, token.data() + token.size(), value);
    if (code != std::errc() || stop != token.data() + token.size() || !std::isfinite(value))
    {
      this->Fail("'" + std::string(token) + "' stands for the " + name + ", which is no number",
        "Check the file, or get it anew");
    }
    return value;
  }

  int Count(const std::string& name, int least)
  {
    const double value = this->Number(name);
    if (value != std::floor(value) || value < least || value > MostValues)
    {
      this->Fail("the " + name + " is " + std::to_string(value),
        "It must be a whole number from " + std::to_string(least));
    }
    return static_cast<int>(value);
  }

  std::vector<double> Numbers(std::size_t count, const std::string& name)
  {
    std::vector<double> values;
    for (std::size_t i = 0; i < count; ++i)
    {
      values.push_back(this->Number(name));
    }
    return values;
  }

  /// Leaves what follows the TILT line to Number.
  void BeginNumbers() { this->Place_ = 0; }

  void ExpectEnd()
  {
    if (this->FindToken())
    {
      this->Last_ = this->Line_ + 1;
      this->Fail("there is more in the file than the numbers of angles say",
        "Check the numbers of vertical and horizontal angles");
    }
  }

private:
  static constexpr const char* Blanks = " \t,\f\v";

  bool FindToken()
  {
    for (; this->Line_ < this->Lines_.size(); ++this->Line_, this->Place_ = 0)
    {
      this->Place_ = this->Lines_[this->Line_].find_first_not_of(Blanks, this->Place_);
      if (this->Place_ != std::string::npos)
      {
        return true;
      }
    }
    return false;
  }

  std::string Where_;
  std::vector<std::string> Lines_;
  std::size_t Line_ = 0;
  std::size_t Place_ = 0;
  /// Line of the last number, from 1.
  std::size_t Last_ = 0;
};

/// Skips header and keywords. Returns what the TILT line says.
std::string FindTilt(Scanner& scanner, const std::string& where)
{
  while (!scanner.AtEnd())
  {
    const std::string& line = scanner.NextLine();
    if (line.compare(0, 5, "TILT=") == 0)
    {
      const std::size_t end = line.find_last_not_of(" \t");
      return line.substr(5, end - 4);
    }
  }
  throw Error(where, "it has no line TILT=", "Give a photometric file of IES LM-63");
}

void CheckAscending(
  const Scanner& scanner, const std::vector<double>& angles, const std::string& name)
{
  for (std::size_t i = 1; i < angles.size(); ++i)
  {
    if (!(angles[i] > angles[i - 1]))
    {
      scanner.Fail("the " + name + " angle " + std::to_string(angles[i]) + " does not follow " +
                     std::to_string(angles[i - 1]),
        "Angles must ascend");
    }
  }
}

void CheckVertical(const Scanner& scanner, std::vector<double>& angles)
{
  CheckAscending(scanner, angles, "vertical");
  const bool low = Same(angles.front(), 0.0) || Same(angles.front(), 90.0);
  const bool high = Same(angles.back(), 90.0) || Same(angles.back(), 180.0);
  if (!low || !high || angles.size() < 2)
  {
    scanner.Fail("the vertical angles go from " + std::to_string(angles.front()) + " to " +
                   std::to_string(angles.back()),
      "Type C photometry begins at 0 or 90 and ends at 90 or 180 degrees");
  }
  angles.front() = std::round(angles.front());
  angles.back() = std::round(angles.back());
}

/// Whether evenly spaced angles go all around and only leave out 360, which is 0 again, as some
/// makers do.
bool GoesRound(const std::vector<double>& angles)
{
  const double step = 360.0 / static_cast<double>(angles.size());
  for (std::size_t i = 0; i < angles.size(); ++i)
  {
    if (!Same(angles[i], static_cast<double>(i) * step))
    {
      return false;
    }
  }
  return angles.size() > 2;
}

/// Fills in the planes that symmetry leaves out. `source` receives the plane of the file that each
/// is equal to.
std::vector<double> AllPlanes(
  const Scanner& scanner, const std::vector<double>& angles, std::vector<std::size_t>& source)
{
  CheckAscending(scanner, angles, "horizontal");
  const double first = angles.front();
  const double last = angles.back();
  std::vector<std::pair<double, std::size_t>> planes;
  const auto add = [&planes](double angle, std::size_t plane)
  {
    const double turned = angle < -SameAngle ? angle + 360.0 : angle;
    planes.emplace_back(turned, plane);
  };
  for (std::size_t i = 0; i < angles.size(); ++i)
  {
    const double angle = angles[i];
    planes.emplace_back(angle, i);
    if (angles.size() == 1 && Same(first, 0.0))
    {
      continue;
    }
    if (Same(first, 0.0) && Same(last, 90.0))
    {
      add(180.0 - angle, i);
      add(180.0 + angle, i);
      add(360.0 - angle, i);
    }
    else if (Same(first, 0.0) && Same(last, 180.0))
    {
      add(360.0 - angle, i);
    }
    else if (Same(first, 90.0) && Same(last, 270.0))
    {
      add(180.0 - angle, i);
      if (Same(angle, 180.0))
      {
        add(360.0, i);
      }
    }
    else if (!Same(first, 0.0) || !(Same(last, 360.0) || GoesRound(angles)))
    {
      scanner.Fail(
        "the horizontal angles go from " + std::to_string(first) + " to " + std::to_string(last),
        "Type C photometry has 0 alone, 0 to 90, 0 to 180, 90 to 270 or 0 to 360 degrees");
    }
    else if (Same(angle, 0.0) && !Same(last, 360.0))
    {
      add(360.0, i);
    }
  }
  std::sort(planes.begin(), planes.end());
  std::vector<double> all;
  for (const auto& [angle, plane] : planes)
  {
    if (all.empty() || !Same(angle, all.back()))
    {
      all.push_back(angle);
      source.push_back(plane);
    }
  }
  all.front() = 0.0;
  if (all.size() > 1)
  {
    all.back() = 360.0;
  }
  return all;
}

} // namespace

PhotometricFile PhotometricFile::Read(const std::string& fileName)
{
  const std::string where = "photometric file '" + fileName + "'";
  return PhotometricFile::Parse(
    ReadTextFile(where, fileName, "Give an IES file of the luminaire's maker"), where);
}

PhotometricFile PhotometricFile::Parse(const std::string& text, const std::string& where)
{
  Scanner scanner(text, where);
  const std::string tilt = FindTilt(scanner, where);
  scanner.BeginNumbers();
  double factor = 1.0;
  if (tilt == "INCLUDE")
  {
    scanner.Count("lamp geometry", 1);
    const int pairs = scanner.Count("number of tilt angles", 1);
    const std::vector<double> angles = scanner.Numbers(pairs, "tilt angle");
    const std::vector<double> factors = scanner.Numbers(pairs, "tilt factor");
    // The luminaire hangs as it was measured.
    const auto level = std::find(angles.begin(), angles.end(), 0.0);
    factor = level == angles.end() ? 1.0 : factors[level - angles.begin()];
  }
  else if (tilt != "NONE")
  {
    throw Error(where, "TILT=" + tilt + " names another file",
      "Use a file with TILT=NONE, or with the tilt factors included");
  }

  PhotometricFile file;
  const int lamps = scanner.Count("number of lamps", 1);
  const double lumens = scanner.Number("lumens of a lamp");
  factor *= scanner.Number("candela multiplier");
  const int verticals = scanner.Count("number of vertical angles", 2);
  const int horizontals = scanner.Count("number of horizontal angles", 1);
  if (static_cast<double>(verticals) * horizontals > MostValues)
  {
    scanner.Fail("there are more than a million intensities", "Check the numbers of angles");
  }
  const int type = scanner.Count("photometric type", 1);
  if (type != 1)
  {
    scanner.Fail("the photometry is of type " + std::string(type == 2   ? "B"
                                                            : type == 3 ? "A"
                                                                        : "?"),
      "Convert it to type C, which luminaires for rooms have");
  }
  const int units = scanner.Count("type of units", 1);
  if (units > 2)
  {
    scanner.Fail(
      "the type of units is " + std::to_string(units), "It must be 1, feet, or 2, metres");
  }
  const double unit = units == 1 ? Foot : 1.0;
  const std::vector<double> size = scanner.Numbers(3, "size of the luminous opening");
  // Negative sizes stand for round openings (LM-63-02, table 1).
  const double round = size[0] < 0.0 || size[1] < 0.0 ? std::sqrt(glm::quarter_pi<double>()) : 1.0;
  file.Width = round * unit * std::abs(size[0]);
  file.Length = round * unit * std::abs(size[1]);
  file.Height = unit * std::abs(size[2]);
  // In LM-63-1986 and -1991 a negative width alone is the diameter of a disc.
  file.Length = size[0] < 0.0 && size[1] == 0.0 ? file.Width : file.Length;
  factor *= scanner.Number("ballast factor");
  factor *= scanner.Number("ballast-lamp photometric factor");
  scanner.Number("input watts");
  if (!(factor > 0.0))
  {
    scanner.Fail("the factors of the intensities multiply to " + std::to_string(factor),
      "Candela multiplier and ballast factors must be positive");
  }
  file.RatedFlux = lumens < 0.0 ? -1.0 : lamps * lumens;

  file.Vertical = scanner.Numbers(verticals, "vertical angle");
  CheckVertical(scanner, file.Vertical);
  std::vector<std::size_t> source;
  const std::vector<double> planes = scanner.Numbers(horizontals, "horizontal angle");
  file.Horizontal = AllPlanes(scanner, planes, source);
  std::vector<double> candela;
  bool shines = false;
  for (int i = 0; i < verticals * horizontals; ++i)
  {
    candela.push_back(factor * scanner.Number("intensity"));
    shines = shines || candela.back() > 0.0;
    if (candela.back() < 0.0)
    {
      scanner.Fail("an intensity is negative", "Check the file, or get it anew");
    }
  }
  scanner.ExpectEnd();
  if (!shines)
  {
    throw Error(where, "all intensities are 0", "Leave a luminaire without light out");
  }
  for (const std::size_t plane : source)
  {
    file.Candela.insert(file.Candela.end(),
      candela.begin() + static_cast<std::ptrdiff_t>(plane * verticals),
      candela.begin() + static_cast<std::ptrdiff_t>((plane + 1) * verticals));
  }
  return file;
}

double PhotometricFile::Flux() const
{
  return IntensityTable::Flux(this->Vertical, this->Horizontal, this->Candela);
}

PhotometricHalf PhotometricFile::Down() const
{
  return this->Half(false);
}

PhotometricHalf PhotometricFile::Up() const
{
  return this->Half(true);
}

double PhotometricFile::At(std::size_t plane, double vertical) const
{
  const std::size_t count = this->Vertical.size();
  const auto after =
    std::upper_bound(this->Vertical.begin() + 1, this->Vertical.end() - 1, vertical);
  const std::size_t i = after - this->Vertical.begin() - 1;
  const double share = (vertical - this->Vertical[i]) / (this->Vertical[i + 1] - this->Vertical[i]);
  const double* const values = &this->Candela[plane * count + i];
  return (1.0 - share) * values[0] + share * values[1];
}

PhotometricHalf PhotometricFile::Half(bool up) const
{
  PhotometricHalf half;
  if (up ? this->Vertical.back() <= 90.0 : this->Vertical.front() >= 90.0)
  {
    return half;
  }
  for (const double angle : this->Vertical)
  {
    const double polar = up ? 180.0 - angle : angle;
    if (polar < 90.0 - SameAngle)
    {
      half.Polar.push_back(polar);
    }
  }
  half.Polar.push_back(90.0);
  std::sort(half.Polar.begin(), half.Polar.end());
  const std::size_t planes = this->Horizontal.size();
  for (std::size_t i = 0; i < planes; ++i)
  {
    // Seen by a plate that faces up the azimuth runs the other way.
    const std::size_t plane = up ? planes - 1 - i : i;
    half.Azimuth.push_back(
      up && planes > 1 ? 360.0 - this->Horizontal[plane] : this->Horizontal[plane]);
    for (const double polar : half.Polar)
    {
      half.Candela.push_back(this->At(plane, up ? 180.0 - polar : polar));
    }
  }
  half.Flux = IntensityTable::Flux(half.Polar, half.Azimuth, half.Candela);
  if (!(half.Flux > 1e-6 * this->Flux()))
  {
    return {};
  }
  return half;
}

} // namespace smokevis
