// One light field that several processes solve together: its bits must be those of one process.
// Threads stand for the processes.
#include "Team.h"
#include "LightField.h"
#include "Scene.h"
#include "SceneLibrary.h"

#include <algorithm>
#include <barrier>
#include <cstring>
#include <thread>

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;

/// What the members of a team of threads meet at.
struct MeetingPlace
{
  explicit MeetingPlace(int size) : Arrivals(size), Parts(size) {}

  std::barrier<> Arrivals;
  /// Of each member.
  std::vector<std::vector<Team::Part>> Parts;
};

class ThreadTeam : public Team
{
public:
  ThreadTeam(MeetingPlace& place, int rank) : Place_(place), Rank_(rank) {}

  int Rank() const override { return this->Rank_; }
  int Size() const override { return static_cast<int>(this->Place_.Parts.size()); }

  void Share(const std::vector<Part>& parts) override
  {
    this->Place_.Parts[this->Rank_] = parts;
    this->Place_.Arrivals.arrive_and_wait();
    for (std::size_t i = 0; i < parts.size(); ++i)
    {
      const int owner = parts[i].Owner;
      const Part& whole = this->Place_.Parts[owner].at(i);
      ASSERT_EQ(owner, whole.Owner);
      ASSERT_EQ(parts[i].Bytes, whole.Bytes);
      // An empty part may have no address.
      if (owner != this->Rank_ && whole.Bytes > 0)
      {
        std::memcpy(parts[i].Data, whole.Data, whole.Bytes);
      }
    }
    this->Place_.Arrivals.arrive_and_wait();
  }

private:
  MeetingPlace& Place_;
  int Rank_;
};

/// Adds the six walls of a box; the front sides of their triangles are outside.
void AddBox(SceneDescription& scene, const Vec3& low, const Vec3& high, const Spectrum& reflectance)
{
  const auto first = static_cast<std::uint32_t>(scene.Surfaces.Points.size());
  for (int corner = 0; corner < 8; ++corner)
  {
    scene.Surfaces.Points.emplace_back(
      corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y, corner & 4 ? high.z : low.z);
  }
  constexpr std::array<std::array<std::uint32_t, 4>, 6> walls = {
    {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}}};
  for (const auto& wall : walls)
  {
    const auto cell = static_cast<std::uint32_t>(scene.Surfaces.CellReflectance.size());
    for (const auto& triangle : {std::array{0, 1, 2}, std::array{0, 2, 3}})
    {
      scene.Surfaces.Triangles.push_back(
        {first + wall[triangle[0]], first + wall[triangle[1]], first + wall[triangle[2]]});
      scene.Surfaces.TriangleCell.push_back(cell);
    }
    scene.Surfaces.CellReflectance.push_back(reflectance);
  }
}

EmitterCell Plate(const Vec3& corner, const Vec3& along, const Vec3& up, double luminance)
{
  EmitterCell cell;
  cell.Vertices = {corner, corner + along, corner + along + up, corner + up};
  cell.Luminance = {luminance, luminance, luminance};
  cell.Reflectance = {0.6, 0.6, 0.6};
  return cell;
}

/// A room with grey walls, coloured smoke that thickens to one side, a lamp, and two signs that
/// reflect.
SceneDescription Room()
{
  SceneDescription scene;
  scene.Bands = 3;
  scene.Albedo = 0.7;
  scene.ExtinctionScale = {1.0, 1.2, 1.4};
  SmokeGrid grid;
  grid.Name = "room";
  for (int i = 0; i <= 12; ++i)
  {
    grid.Nodes[0].push_back(4.0 * i / 12);
    grid.Nodes[1].push_back(3.0 * i / 12);
    grid.Nodes[2].push_back(2.4 * i / 12);
  }
  for (int cell = 0; cell < 12 * 12 * 12; ++cell)
  {
    grid.Extinction.push_back(0.1F * static_cast<float>(cell % 12));
  }
  scene.Grids = {grid};
  AddBox(scene, Vec3(0.0), {4.0, 3.0, 2.4}, {0.5, 0.4, 0.3});
  for (int sign = 0; sign < 3; ++sign)
  {
    EmitterCell cell = Plate({0.01, 0.5 + 0.7 * sign, 1.6}, {0, 0.4, 0}, {0, 0, 0.2}, 100.0);
    cell.Luminance[1] = 200.0 + sign;
    cell.SignId = sign < 2 ? sign : -1;
    scene.Emitters.push_back(cell);
  }
  // One that only reflects, beside the lamp, which shines past it.
  for (int half = 0; half < 2; ++half)
  {
    EmitterCell cell = Plate({0.01, 2.3, 1.3 + 0.1 * half}, {0, 0.4, 0}, {0, 0, 0.1}, 0.0);
    cell.Reflectance.fill(half == 0 ? 0.8 : 0.1);
    cell.SignId = 2;
    scene.Emitters.push_back(cell);
  }
  return scene;
}

/// The same with a closed white box around a faint lamp, whose light is balanced by itself.
SceneDescription RoomWithWhiteBox()
{
  SceneDescription scene = Room();
  scene.Bands = 1;
  AddBox(scene, {2.0, 1.0, 1.0}, {2.6, 1.6, 1.6}, {0.99, 0.99, 0.99});
  scene.Emitters.push_back(Plate({2.3, 1.3, 1.5}, {0, 0.05, 0}, {0.05, 0, 0}, 0.1));
  return scene;
}

LightFieldOptions Coarse()
{
  LightFieldOptions options;
  options.Tolerance = 0.1;
  return options;
}

/// @param options of all of them
std::vector<LightField> SolveTogether(
  const Scene& scene, int size, LightFieldOptions options = Coarse())
{
  MeetingPlace place(size);
  std::vector<LightField> fields(size);
  std::vector<std::thread> members;
  for (int rank = 0; rank < size; ++rank)
  {
    members.emplace_back(
      [&, rank, options]() mutable
      {
        ThreadTeam team(place, rank);
        options.Threads = 1;
        options.Colleagues = &team;
        Progress progress;
        fields[rank] = SolveLightField(scene, options, progress);
      });
  }
  for (std::thread& member : members)
  {
    member.join();
  }
  return fields;
}

template <class Value>
bool SameBits(const std::vector<Value>& first, const std::vector<Value>& second)
{
  return first.size() == second.size() &&
         std::memcmp(first.data(), second.data(), first.size() * sizeof(Value)) == 0;
}

double Count(const LightField& field, const std::string& what)
{
  const auto item = std::find_if(field.Report.begin(), field.Report.end(),
    [&](const WorkItem& candidate) { return candidate.What == what; });
  return item == field.Report.end() ? 0.0 : item->Count;
}

TEST(TeamTest, AnyNumberOfProcessesGivesTheSameBits)
{
  const Scene scene(Room());
  const LightFieldOptions options = Coarse();
  Progress progress;
  const LightField alone = SolveLightField(scene, options, progress);
  ASSERT_GT(Count(alone, "band 0: rays gathered by signs"), 0.0);
  ASSERT_NE(alone.MultipleGradient.back(), glm::vec3(0.0F));
  ASSERT_GT(Count(alone, "band 2: counted sweeps"), 0.0);
  const double lines = Batches * Count(alone, "band 0: lines of a batch in all");
  const double sweeps =
    Count(alone, "band 0: counted sweeps") + Count(alone, "band 0: settling sweeps");
  EXPECT_LT(lines, Batches * Count(alone, "band 0: lines a sweep and batch") * sweeps);
  EXPECT_GT(lines, Batches * Count(alone, "band 0: lines a sweep and batch") *
                     Count(alone, "band 0: counted sweeps"));
  // With more processes than batches some of them have none.
  for (const int size : {1, 2, 3, 17})
  {
    const std::vector<LightField> together = SolveTogether(scene, size);
    double shared = 0.0;
    for (int rank = 0; rank < size; ++rank)
    {
      const LightField& own = together[rank];
      SCOPED_TRACE("process " + std::to_string(rank) + " of " + std::to_string(size));
      EXPECT_TRUE(SameBits(alone.DirectFluence, own.DirectFluence));
      EXPECT_TRUE(SameBits(alone.MultipleFluence, own.MultipleFluence));
      EXPECT_TRUE(SameBits(alone.DirectIlluminance, own.DirectIlluminance));
      EXPECT_TRUE(SameBits(alone.MultipleIlluminance, own.MultipleIlluminance));
      EXPECT_TRUE(SameBits(alone.MultipleGradient, own.MultipleGradient));
      ASSERT_EQ(own.Report.size(), together[0].Report.size());
      for (std::size_t i = 0; i < own.Report.size(); ++i)
      {
        EXPECT_EQ(own.Report[i].What, together[0].Report[i].What);
        EXPECT_EQ(own.Report[i].Count, together[0].Report[i].Count);
      }
      // Counts of the work are those of one process.
      for (const WorkItem& item : alone.Report)
      {
        if (item.What.find("process") == std::string::npos)
        {
          EXPECT_EQ(Count(own, item.What), Count(alone, item.What)) << item.What;
        }
      }
      const double part = Count(own, "band 0: lines of process " + std::to_string(rank));
      shared += part;
      EXPECT_LE(part, size == 1 ? 0.0 : lines * ((Batches + size - 1) / size) / Batches);
    }
    if (size > 1)
    {
      EXPECT_EQ(shared, lines);
    }
  }
}

TEST(TeamTest, LightThatIsBalancedByItself)
{
  const Scene scene(RoomWithWhiteBox());
  const LightFieldOptions options = Coarse();
  Progress progress;
  const LightField alone = SolveLightField(scene, options, progress);
  for (const LightField& own : SolveTogether(scene, 3))
  {
    EXPECT_TRUE(SameBits(alone.MultipleFluence, own.MultipleFluence));
    EXPECT_TRUE(SameBits(alone.MultipleIlluminance, own.MultipleIlluminance));
  }
}

TEST(TeamTest, LinesWhereNoiseIs)
{
  const Scene scene(scenes::FlameBehindADoor());
  LightFieldOptions options;
  options.Tolerance = 0.007;
  options.Seed = 2;
  Progress progress;
  const LightField alone = SolveLightField(scene, options, progress);
  ASSERT_GT(Count(alone, "band 0: boxes that more lines lead through"), 0.0);
  for (const LightField& own : SolveTogether(scene, 3, options))
  {
    EXPECT_TRUE(SameBits(own.MultipleFluence, alone.MultipleFluence));
    EXPECT_TRUE(SameBits(own.MultipleIlluminance, alone.MultipleIlluminance));
  }
}

TEST(TeamTest, ItemsAreSharedOutOnce)
{
  for (const int size : {1, 2, 3, 17})
  {
    MeetingPlace place(size);
    std::vector<int> owners(16, 0);
    for (int rank = 0; rank < size; ++rank)
    {
      const ThreadTeam team(place, rank);
      for (std::size_t i = 0; i < team.OwnCount(owners.size()); ++i)
      {
        ASSERT_LT(team.OwnItem(i), owners.size());
        EXPECT_TRUE(team.IsOwn(team.OwnItem(i)));
        ++owners[team.OwnItem(i)];
      }
    }
    EXPECT_EQ(owners, std::vector<int>(16, 1));
  }
}

} // namespace
