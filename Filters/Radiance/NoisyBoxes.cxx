#include "NoisyBoxes.h"

#include "Places.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace smokevis
{

namespace
{

constexpr std::size_t MostBoxes = 8;
/// Share of variance times work that a box takes off at least.
constexpr double LeastGain = 0.1;
/// How many times as many lines a box gets at most: how noisy some places are few lines tell.
constexpr double MostTimes = 32.0;
/// Share of all variance that counts which one line has at most: a few must not decide.
constexpr double MostOfOne = 0.01;
/// Share of all lines that meet a box at most.
constexpr double MostMet = 0.1;
/// Cells of the raster, along the longest edge of the scene, that boxes are made of.
constexpr int Steps = 32;

/// A line as it counts, with what boxes got so far.
struct CountedLine
{
  glm::vec3 Origin, Direction, Inverse;
  float Density, Variance;
  /// How many lines it stands for.
  float Lines = 1.0F;
};

/// Of all lines and all their variance.
struct Share
{
  double Lines = 0.0, Variance = 0.0;
  /// Of the lines that were surveyed.
  double Surveyed = 0.0;

  void Add(const CountedLine& line)
  {
    this->Lines += line.Lines;
    this->Variance += line.Variance;
    this->Surveyed += 1.0;
  }
  Share Over(const Share& all) const
  {
    return all.Variance > 0.0 ? Share{this->Lines / all.Lines, this->Variance / all.Variance,
                                  this->Surveyed / all.Surveyed}
                              : Share{};
  }
  /// Share of variance times work that is taken off if a box gets as many lines as it should; 0
  /// where it should get no more.
  double Gain() const
  {
    const double left = std::sqrt(this->Variance * this->Lines) +
                        std::sqrt((1.0 - this->Variance) * (1.0 - this->Lines));
    return this->Variance > this->Lines ? 1.0 - left * left : 0.0;
  }
  /// How many times its lines those are.
  double Times() const
  {
    const double odds = this->Variance / (1.0 - this->Variance);
    return std::clamp(std::sqrt(odds / this->Lines * (1.0 - this->Lines)), 1.0, MostTimes);
  }
};

/// A box of the raster's cells.
struct Part
{
  std::array<int, 3> First, End;
};

/// What counts of any one line at most.
float LargestSquare(const std::vector<SurveyedLine>& lines)
{
  constexpr int MostRounds = 32;
  double most = std::numeric_limits<float>::max();
  for (int round = 0; round < MostRounds; ++round)
  {
    double all = 0.0;
    for (const SurveyedLine& line : lines)
    {
      all += std::min<double>(line.Square, most);
    }
    if (most <= 1.01 * MostOfOne * all)
    {
      break;
    }
    most = MostOfOne * all;
  }
  return static_cast<float>(most);
}

class Search
{
public:
  Search(const std::vector<SurveyedLine>& lines, const Box& scene, std::size_t count)
      : Lower_(scene.Lower),
        SweepOver_(static_cast<double>(count) / static_cast<double>(lines.size()))
  {
    const Vec3 size = scene.Size();
    const float most = LargestSquare(lines);
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Size_[axis] =
        std::max(1, static_cast<int>(std::lround(size[axis] / LargestEdge(size) * Steps)));
      this->Edge_[axis] = size[axis] / this->Size_[axis];
    }
    for (std::size_t i = 0; i < lines.size(); ++i)
    {
      const SurveyedLine& line = lines[i];
      this->Halves_[2 * i / lines.size()].push_back({line.Origin, line.Direction,
        1.0F / line.Direction, line.Density, std::min(line.Square, most)});
    }
  }

  /// The box to gain most by, which gets its lines; none where there is too little to gain.
  std::optional<NoisyBox> Next()
  {
    const Part part = this->Grown(this->Noisiest());
    if (this->ShareOf(part, this->Halves_[0]).Gain() < LeastGain ||
        this->ShareOf(part, this->Halves_[1]).Gain() < LeastGain)
    {
      return std::nullopt;
    }
    NoisyBox box{{this->CornerOf(part.First), this->CornerOf(part.End)}};
    box.Bounds.Lower += this->Lower_;
    box.Bounds.Upper += this->Lower_;
    Share all;
    Share met;
    for (const std::vector<CountedLine>& half : this->Halves_)
    {
      this->AddShares(part, half, all, met);
    }
    box.Lines = this->SweepOver_ * met.Lines * (met.Over(all).Times() - 1.0);
    this->Take(part, box.Lines / box.Bounds.Surface());
    return box;
  }

private:
  Vec3 CornerOf(const std::array<int, 3>& place) const
  {
    return Vec3(place[0], place[1], place[2]) * this->Edge_;
  }

  /// Calls visit(line, whether it meets the part) for lines.
  template <class Lines, class Visit>
  void ForEach(const Part& part, Lines& lines, Visit&& visit) const
  {
    const glm::vec3 lower(this->CornerOf(part.First));
    const glm::vec3 upper(this->CornerOf(part.End));
    for (auto& line : lines)
    {
      const glm::vec3 one = (lower - line.Origin) * line.Inverse;
      const glm::vec3 other = (upper - line.Origin) * line.Inverse;
      const glm::vec3 enter = glm::min(one, other);
      const glm::vec3 leave = glm::max(one, other);
      visit(line, std::max({enter.x, enter.y, enter.z}) < std::min({leave.x, leave.y, leave.z}));
    }
  }

  void AddShares(
    const Part& part, const std::vector<CountedLine>& lines, Share& all, Share& met) const
  {
    this->ForEach(part, lines,
      [&](const CountedLine& line, bool meets)
      {
        all.Add(line);
        if (meets)
        {
          met.Add(line);
        }
      });
  }

  Share ShareOf(const Part& part, const std::vector<CountedLine>& lines) const
  {
    Share all;
    Share met;
    this->AddShares(part, lines, all, met);
    return met.Over(all);
  }

  /// The cell of the raster to gain most by, as the first half tells.
  Part Noisiest() const
  {
    const auto count = [this](int axis) { return static_cast<std::size_t>(this->Size_[axis]); };
    std::vector<Share> cells(count(0) * count(1) * count(2));
    const auto indexOf = [&](const std::array<int, 3>& place)
    { return place[0] + count(0) * (place[1] + count(1) * place[2]); };
    Share all;
    const glm::vec3 edge(this->Edge_);
    const float step = 0.5F * std::min({edge.x, edge.y, edge.z});
    for (const CountedLine& line : this->Halves_[0])
    {
      all.Add(line);
      std::size_t last = cells.size();
      for (float way = step;; way += step)
      {
        const glm::ivec3 at(glm::floor((line.Origin + way * line.Direction) / edge));
        const std::array<int, 3> place = {at.x, at.y, at.z};
        if (glm::any(glm::lessThan(at, glm::ivec3(0))) || at.x >= this->Size_[0] ||
            at.y >= this->Size_[1] || at.z >= this->Size_[2])
        {
          break;
        }
        if (indexOf(place) != last)
        {
          last = indexOf(place);
          cells[last].Add(line);
        }
      }
    }
    Part noisiest{{0, 0, 0}, this->Size_};
    double most = 0.0;
    ForEachPlace(this->Size_,
      [&](const std::array<int, 3>& place)
      {
        if (const double gain = cells[indexOf(place)].Over(all).Gain(); gain > most)
        {
          most = gain;
          noisiest = {place, {place[0] + 1, place[1] + 1, place[2] + 1}};
        }
      });
    return noisiest;
  }

  /// Moves the faces of a part outwards, by a cell or by half of its width, as long as that gains
  /// more.
  Part Grown(Part part) const
  {
    double most = this->ShareOf(part, this->Halves_[0]).Gain();
    for (bool grown = true; grown;)
    {
      grown = false;
      const Part before = part;
      for (int face = 0; face < 6; ++face)
      {
        const int axis = face / 2;
        for (const int step : {1, std::max(1, (before.End[axis] - before.First[axis]) / 2)})
        {
          Part larger = before;
          int& bound = face % 2 == 0 ? larger.First[axis] : larger.End[axis];
          bound = std::clamp(face % 2 == 0 ? bound - step : bound + step, 0, this->Size_[axis]);
          const Share share = this->ShareOf(larger, this->Halves_[0]);
          if (share.Gain() > most && share.Surveyed < MostMet)
          {
            most = share.Gain();
            part = larger;
            grown = true;
          }
        }
      }
    }
    return part;
  }

  /// Lets further lines lead through a part.
  /// @param density of them [1/m2]
  void Take(const Part& part, double density)
  {
    for (std::vector<CountedLine>& half : this->Halves_)
    {
      this->ForEach(part, half,
        [density](CountedLine& line, bool meets)
        {
          const float times = meets ? 1.0F + static_cast<float>(density) / line.Density : 1.0F;
          line.Density *= times;
          line.Lines *= times;
          line.Variance /= times;
        });
    }
  }

  Vec3 Lower_;
  /// Lines of a sweep over those surveyed.
  double SweepOver_;
  std::array<int, 3> Size_{};
  Vec3 Edge_{0.0};
  /// The first one looks for boxes, the second has to confirm them.
  std::array<std::vector<CountedLine>, 2> Halves_;
};

} // namespace

std::vector<NoisyBox> FindNoisyBoxes(
  const std::vector<SurveyedLine>& lines, const Box& scene, std::size_t count)
{
  std::vector<NoisyBox> boxes;
  if (lines.empty())
  {
    return boxes;
  }
  Search search(lines, scene, count);
  while (boxes.size() < MostBoxes)
  {
    const std::optional<NoisyBox> box = search.Next();
    if (!box)
    {
      break;
    }
    boxes.push_back(*box);
  }
  double more = 0.0;
  for (const NoisyBox& box : boxes)
  {
    more += box.Lines;
  }
  for (NoisyBox& box : boxes)
  {
    box.Lines *= std::min(1.0, static_cast<double>(count) / more);
  }
  return boxes;
}

} // namespace smokevis
