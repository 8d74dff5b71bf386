#include "CutCells.h"

#include "CellWalls.h"
#include "PolygonClip.h"
#include "Scene.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <boost/pending/disjoint_sets.hpp>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace smokevis
{

namespace
{

/// What lies within this share of a cell's shortest edge of a plane lies in it: curved walls are
/// cut by few planes.
constexpr double FlatShare = 0.01;
/// Least area of a wall in a cell, and least volume that is cut off, as shares of the cell's.
constexpr double LeastArea = 1e-3;
constexpr double LeastVolume = 1e-3;
/// Most planes on the way to a piece of a cell, and most triangles whose planes are considered.
constexpr int MostPlanes = 6;
constexpr std::size_t MostCandidates = 16;
/// Light passes between two pieces of a cell where more than half of so many ways are clear.
constexpr int Ways = 6;
/// A smaller share of a part than this is none.
constexpr double Rounding = 1e-6;
/// Samples of a smaller share of a part are left out.
constexpr double LeastShare = 0.005;

using Polygon = std::vector<Vec3>;

/// Cuts one cell. Places count from the smoke's lower corner.
class CellCutter
{
public:
  CellCutter(const Scene& scene, std::int64_t cell) : Scene_(scene), Base_(scene.Smoke().Lower())
  {
    const Vec3 size = scene.Smoke().CellSize(cell);
    const Vec3 lower = scene.Smoke().CellCentre(cell) - this->Base_ - 0.5 * size;
    this->Box_ = {lower, lower + size};
    this->Volume_ = scene.Smoke().CellVolume(cell);
    this->Flat_ = FlatShare * std::min({size.x, size.y, size.z});
    this->LeastArea_ = LeastArea * std::pow(this->Volume_, 2.0 / 3.0);
    this->Cut_.Cell = cell;
    for (const Box& own : scene.Smoke().OwnBoxes(cell))
    {
      this->Own_.push_back({own.Lower - this->Base_, own.Upper - this->Base_});
    }
  }

  void AddWall(const Triangle& corners)
  {
    const Polygon polygon = InBox(
      {corners[0] - this->Base_, corners[1] - this->Base_, corners[2] - this->Base_}, this->Box_);
    const double area = glm::length(AreaVector(polygon));
    if (area > this->LeastArea_ && AreaOf(corners) > 0.0)
    {
      const Vec3 normal = glm::normalize(AreaVector(corners));
      this->Walls_.push_back({{normal, glm::dot(normal, polygon[0])}, polygon, area});
    }
  }

  /// None where light fills the whole cell.
  std::optional<CellCut> Run()
  {
    if (this->Walls_.empty())
    {
      return std::nullopt;
    }
    const std::int32_t root =
      this->Divide(ConvexSolid(this->Box_), std::move(this->Walls_), MostPlanes);
    this->MakeParts();
    if (this->Cut_.Parts.size() < 2)
    {
      return std::nullopt;
    }
    const std::vector<CellCut::Node> nodes = std::move(this->Cut_.Nodes);
    this->Cut_.Nodes.clear();
    this->Simplify(nodes, root);
    return std::move(this->Cut_);
  }

private:
  struct Wall
  {
    Plane Where;
    Polygon Corners;
    double Area;
  };
  /// An eighth of a piece.
  struct Sample
  {
    double Volume;
    Vec3 Centre, Size;
  };
  struct Piece
  {
    double Volume, OwnVolume;
    Vec3 Centre;
    std::vector<Sample> Samples;
    /// The place of the part that it belongs to.
    std::int32_t Part = -1;
  };

  bool LiesIn(const Wall& wall, const Plane& plane) const
  {
    return std::all_of(wall.Corners.begin(), wall.Corners.end(),
      [&](const Vec3& corner) { return std::abs(plane.Height(corner)) <= this->Flat_; });
  }

  /// The plane that most walls lie in.
  Plane ChoosePlane(std::vector<Wall>& walls) const
  {
    if (walls.size() > MostCandidates)
    {
      std::stable_sort(
        walls.begin(), walls.end(), [](const Wall& a, const Wall& b) { return a.Area > b.Area; });
    }
    Plane best;
    double most = -1.0;
    for (std::size_t i = 0; i < std::min(MostCandidates, walls.size()); ++i)
    {
      double area = 0.0;
      for (const Wall& wall : walls)
      {
        area += this->LiesIn(wall, walls[i].Where) ? wall.Area : 0.0;
      }
      // Of equal ones the first, whatever rounding says.
      if (area > most * (1.0 + 1e-6))
      {
        most = area;
        best = walls[i].Where;
      }
    }
    return best;
  }

  /// Returns a node, or -1 - the place of a piece.
  std::int32_t Divide(ConvexSolid solid, std::vector<Wall> walls, int planes)
  {
    while (!walls.empty() && planes > 0)
    {
      const Plane plane = this->ChoosePlane(walls);
      std::erase_if(walls, [&](const Wall& wall) { return this->LiesIn(wall, plane); });
      auto [front, behind] = solid.Cut(plane);
      if (front.Empty() || behind.Empty() || front.Volume() < LeastVolume * this->Volume_ ||
          behind.Volume() < LeastVolume * this->Volume_)
      {
        continue;
      }
      const auto node = static_cast<std::int32_t>(this->Cut_.Nodes.size());
      this->Cut_.Nodes.push_back({plane});
      const std::int32_t first =
        this->Divide(std::move(front), this->OnSide(walls, plane, 1.0), planes - 1);
      const std::int32_t second =
        this->Divide(std::move(behind), this->OnSide(walls, plane, -1.0), planes - 1);
      this->Cut_.Nodes[node].Front = first;
      this->Cut_.Nodes[node].Behind = second;
      return node;
    }
    this->AddPiece(solid);
    return -static_cast<std::int32_t>(this->Pieces_.size());
  }

  std::vector<Wall> OnSide(const std::vector<Wall>& walls, const Plane& plane, double sign) const
  {
    std::vector<Wall> kept;
    for (const Wall& wall : walls)
    {
      Wall part{wall.Where, {}, 0.0};
      KeepSide(
        wall.Corners, [&](const Vec3& point) { return sign * plane.Height(point); }, part.Corners);
      part.Area = glm::length(AreaVector(part.Corners));
      if (part.Area > this->LeastArea_)
      {
        kept.push_back(std::move(part));
      }
    }
    return kept;
  }

  /// Volume of what finer grids leave of a solid.
  double OwnVolume(const ConvexSolid& solid) const
  {
    double volume = 0.0;
    for (const Box& own : this->Own_)
    {
      ConvexSolid inside = solid;
      for (int axis = 0; axis < 3 && !inside.Empty(); ++axis)
      {
        Plane end;
        end.Normal[axis] = 1.0;
        end.Offset = own.Lower[axis];
        inside = inside.Cut(end).first;
        if (!inside.Empty())
        {
          end.Offset = own.Upper[axis];
          inside = inside.Cut(end).second;
        }
      }
      volume += inside.Empty() ? 0.0 : inside.Volume();
    }
    return volume;
  }

  void AddPiece(const ConvexSolid& solid)
  {
    Piece piece{solid.Volume(), this->OwnVolume(solid), solid.Centre(), {}};
    const Box bounds = solid.Bounds();
    std::vector<ConvexSolid> eighths = {solid};
    for (int axis = 0; axis < 3; ++axis)
    {
      Plane middle;
      middle.Normal[axis] = 1.0;
      middle.Offset = 0.5 * (bounds.Lower[axis] + bounds.Upper[axis]);
      std::vector<ConvexSolid> halves;
      for (const ConvexSolid& part : eighths)
      {
        auto [high, low] = part.Cut(middle);
        halves.push_back(std::move(low));
        halves.push_back(std::move(high));
      }
      eighths = std::move(halves);
    }
    for (const ConvexSolid& part : eighths)
    {
      const double volume = part.Empty() ? 0.0 : part.Volume();
      if (volume > LeastShare * piece.Volume)
      {
        const Box own = part.Bounds();
        piece.Samples.push_back({volume, part.Centre(), own.Upper - own.Lower});
      }
    }
    this->Pieces_.push_back(std::move(piece));
  }

  bool Open(const Piece& one, const Piece& other) const
  {
    int clear = 0;
    for (int way = 0; way < Ways; ++way)
    {
      const Vec3& from = one.Samples[3 * way % one.Samples.size()].Centre;
      const Vec3& to = other.Samples[(5 * way + 1) % other.Samples.size()].Centre;
      const double length = glm::distance(from, to);
      clear += length > 0.0 && !this->Scene_.Shapes().Occluded(
                                 this->Base_ + from, (to - from) / length, 0.0, length)
                 ? 1
                 : 0;
    }
    return 2 * clear > Ways;
  }

  /// Pieces that light passes between, also by way of others, are one part.
  void MakeParts()
  {
    boost::disjoint_sets_with_storage<> joined(this->Pieces_.size());
    for (std::size_t i = 0; i < this->Pieces_.size(); ++i)
    {
      for (std::size_t j = 0; j < i; ++j)
      {
        if (joined.find_set(i) != joined.find_set(j) &&
            this->Open(this->Pieces_[i], this->Pieces_[j]))
        {
          joined.union_set(i, j);
        }
      }
    }
    // In the order of the first piece of each.
    std::vector<std::int32_t> partOf(this->Pieces_.size(), -1);
    std::int32_t parts = 0;
    for (std::size_t i = 0; i < this->Pieces_.size(); ++i)
    {
      std::int32_t& part = partOf[joined.find_set(i)];
      part = part < 0 ? parts++ : part;
      this->Pieces_[i].Part = part;
    }
    for (std::int32_t part = 0; part < parts; ++part)
    {
      this->Cut_.Parts.push_back(this->MakePart(part));
    }
  }

  CellPart MakePart(std::int32_t place) const
  {
    CellPart part;
    Vec3 centre(0.0);
    double sampled = 0.0;
    for (const Piece& piece : this->Pieces_)
    {
      if (piece.Part == place)
      {
        part.Volume += piece.Volume;
        part.OwnVolume += piece.OwnVolume;
        centre += piece.Volume * piece.Centre;
        for (const Sample& sample : piece.Samples)
        {
          sampled += sample.Volume;
        }
      }
    }
    // What rounding leaves or takes is nothing.
    const double own = part.OwnVolume / part.Volume;
    part.OwnVolume = own < Rounding ? 0.0 : own > 1.0 - Rounding ? part.Volume : part.OwnVolume;
    centre /= part.Volume;
    part.Centre = this->Base_ + centre;
    Vec3 spread(0.0);
    for (const Piece& piece : this->Pieces_)
    {
      if (piece.Part != place)
      {
        continue;
      }
      part.Coarse.push_back(
        {piece.Centre - centre, static_cast<float>(piece.Volume / part.Volume)});
      for (const Sample& sample : piece.Samples)
      {
        const Vec3 off = sample.Centre - centre;
        const double share = sample.Volume / sampled;
        spread += share * (12.0 * off * off + sample.Size * sample.Size);
        part.Fine.push_back({off, static_cast<float>(share)});
      }
    }
    part.Size = glm::sqrt(spread);
    return part;
  }

  /// Adds the nodes that part parts to the cut.
  std::int32_t Simplify(const std::vector<CellCut::Node>& nodes, std::int32_t from)
  {
    if (from < 0)
    {
      return -1 - this->Pieces_[-1 - from].Part;
    }
    const std::size_t place = this->Cut_.Nodes.size();
    this->Cut_.Nodes.push_back({nodes[from].Where});
    const std::int32_t front = this->Simplify(nodes, nodes[from].Front);
    const std::int32_t behind = this->Simplify(nodes, nodes[from].Behind);
    if (front == behind && front < 0)
    {
      this->Cut_.Nodes.resize(place);
      return front;
    }
    this->Cut_.Nodes[place].Front = front;
    this->Cut_.Nodes[place].Behind = behind;
    return static_cast<std::int32_t>(place);
  }

  const Scene& Scene_;
  Vec3 Base_;
  Box Box_;
  double Volume_, Flat_, LeastArea_;
  /// What finer grids leave of the cell.
  std::vector<Box> Own_;
  std::vector<Wall> Walls_;
  std::vector<Piece> Pieces_;
  CellCut Cut_;
};

} // namespace

//--------------------------------------------------------------------------------------------------
CellParts FindCellParts(const Scene& scene)
{
  const Medium& smoke = scene.Smoke();
  const CellWalls found(scene);
  // Where the meetings of each cell begin.
  std::vector<std::size_t> first;
  for (std::size_t i = 0; i < found.Meetings.size(); ++i)
  {
    if (i == 0 || found.Meetings[i].Cell != found.Meetings[i - 1].Cell)
    {
      first.push_back(i);
    }
  }
  std::vector<std::optional<CellCut>> cuts(first.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, first.size(), 64),
    [&](const tbb::blocked_range<std::size_t>& range)
    {
      for (std::size_t i = range.begin(); i < range.end(); ++i)
      {
        CellCutter cutter(scene, found.Meetings[first[i]].Cell);
        const std::size_t end = i + 1 < first.size() ? first[i + 1] : found.Meetings.size();
        for (std::size_t meeting = first[i]; meeting < end; ++meeting)
        {
          cutter.AddWall(found.Walls[found.Meetings[meeting].Wall]);
        }
        cuts[i] = cutter.Run();
      }
    });
  std::vector<CellCut> kept;
  for (std::optional<CellCut>& cut : cuts)
  {
    if (cut)
    {
      kept.push_back(std::move(*cut));
    }
  }
  return CellParts(static_cast<std::int64_t>(smoke.Cells()), smoke.Lower(),
    1e-6 * smoke.LargestEdge(), std::move(kept));
}

} // namespace smokevis
