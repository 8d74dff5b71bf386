// Walls: areas and directions that can be worked out by hand.
#include "FormatsTestRun.h"
#include "SolidCells.h"
#include "SrgbColor.h"
#include "WallBuilder.h"

#include <gmock/gmock.h>

#include <cmath>
#include <map>

using testing::ElementsAre;

namespace smokevis
{

namespace
{

using Index = test::Index;

/// The walls of a run, with sums that are easy to state.
class Walls
{
public:
  explicit Walls(Index& index, double time = 0.0, double leastOpacity = 0.5)
      : folder_("walls"), run_(folder_.Write("test.smv", index.Bytes())),
        builder_(run_, time, leastOpacity), quads_(builder_.Build())
  {
  }

  const std::vector<WallQuad>& Quads() const { return quads_; }
  const WallBuilder& Builder() const { return builder_; }

  static double Area(const WallQuad& quad)
  {
    const int b = (quad.Axis + 1) % 3;
    const int d = (quad.Axis + 2) % 3;
    return (quad.High[b] - quad.Low[b]) * (quad.High[d] - quad.Low[d]);
  }

  /// All of it, or that of one surface.
  double Area(const std::string& surface = {}) const
  {
    double area = 0.0;
    for (const WallQuad& quad : quads_)
    {
      const int number = builder_.Materials()[quad.Material].Surface;
      area += surface.empty() || run_.Surfaces[number].Name == surface ? Area(quad) : 0.0;
    }
    return area;
  }

  /// Area facing along +axis or -axis at a coordinate.
  double AreaAt(int axis, bool positive, double coordinate) const
  {
    double area = 0.0;
    for (const WallQuad& quad : quads_)
    {
      const bool here = quad.Axis == axis && quad.Positive == positive &&
                        std::abs(quad.Low[axis] - coordinate) < 1e-9;
      area += here ? Area(quad) : 0.0;
    }
    return area;
  }

  /// The sum of area times normal; nothing for a closed surface.
  std::array<double, 3> Flux() const
  {
    std::array<double, 3> flux{};
    for (const WallQuad& quad : quads_)
    {
      flux[quad.Axis] += (quad.Positive ? 1.0 : -1.0) * Area(quad);
    }
    return flux;
  }

private:
  test::Folder folder_;
  SmvFile run_;
  WallBuilder builder_;
  std::vector<WallQuad> quads_;
};

Index Room()
{
  Index index;
  index.Mesh("m", {4, 3, 2}, {0, 0, 0}, {4, 3, 2});
  return index;
}

} // namespace

TEST(WallQuad, CornersTurnCounterClockwiseSeenFromTheGas)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const bool positive : {false, true})
    {
      WallQuad quad;
      quad.Axis = axis;
      quad.Positive = positive;
      quad.High = {1, 1, 1};
      quad.High[axis] = 0;
      const auto c = quad.Corners();
      const int b = (axis + 1) % 3;
      const int d = (axis + 2) % 3;
      const double normal =
        (c[1][b] - c[0][b]) * (c[2][d] - c[0][d]) - (c[1][d] - c[0][d]) * (c[2][b] - c[0][b]);
      EXPECT_EQ(normal, positive ? 1.0 : -1.0);
    }
  }
}

TEST(Walls, AClosedRoomIsSixQuadsInwards)
{
  Index index = Room();
  const Walls walls(index);
  EXPECT_EQ(walls.Quads().size(), 6U);
  EXPECT_EQ(walls.Area("WALL"), 2 * (12 + 8 + 6));
  EXPECT_THAT(walls.Flux(), ElementsAre(0, 0, 0));
  EXPECT_EQ(walls.AreaAt(2, true, 0.0), 12.0);
  EXPECT_EQ(walls.AreaAt(2, false, 2.0), 12.0);
}

TEST(Walls, ABlockCoversTheFloorUnderIt)
{
  Index index = Room();
  index.Obstruction({1, 3, 1, 2, 0, 1}, Index::Paint);
  const Walls walls(index);
  EXPECT_EQ(walls.Area("PAINT"), 2 + 2 * (2 + 1)); // top and four sides of 2 x 1 x 1
  EXPECT_EQ(walls.Area("WALL"), 52 - 2);
  EXPECT_THAT(walls.Flux(), ElementsAre(0, 0, 0));
}

TEST(Walls, TouchingBlocksShareNoFace)
{
  Index index = Room();
  index.Obstruction({1, 2, 1, 2, 0, 1}, Index::Paint);
  index.Obstruction({2, 3, 1, 2, 0, 1}, Index::Paint);
  const Walls walls(index);
  EXPECT_EQ(walls.Area("PAINT"), 8.0);
  // The two blocks' equal faces merge: top, two long sides, two ends.
  EXPECT_EQ(std::count_if(walls.Quads().begin(), walls.Quads().end(),
              [](const WallQuad& q) {
                return q.Low[0] >= 1 && q.High[0] <= 3 && q.High[2] <= 1 && q.Low[1] >= 1 &&
                       q.High[1] <= 2;
              }),
    5);
}

TEST(Walls, ThePlateIsOneQuad)
{
  Index index = Room();
  index.Obstruction({2, 2, 0, 2, 0, 1}, Index::Paint);
  const Walls walls(index);
  EXPECT_EQ(walls.Area("PAINT"), 2.0);
  EXPECT_EQ(walls.AreaAt(0, true, 2.0) + walls.AreaAt(0, false, 2.0), 2.0);
}

TEST(Walls, APlateInASolidsFaceOrWithoutAreaIsNotSeenTwice)
{
  Index index = Room();
  index.Obstruction({0, 2, 0, 3, 0, 2}, Index::Wall);
  index.Obstruction({2, 2, 0, 3, 0, 1}, Index::Paint); // covers half of the block's side
  index.Obstruction({1, 1, 0, 3, 0, 1}, Index::Paint); // inside the block
  index.Obstruction({3, 3, 0, 3, 1, 1}, Index::Paint); // a line
  const Walls walls(index);
  EXPECT_EQ(walls.Area("PAINT"), 3.0);
  EXPECT_EQ(walls.AreaAt(0, true, 2.0), 6.0);
  EXPECT_EQ(walls.Area(), 2 * (6 + 4 + 6));
  EXPECT_THAT(walls.Flux(), ElementsAre(0, 0, 0));
}

TEST(Walls, OpeningsAreOpenAndVentsPaint)
{
  Index index = Room();
  index.Vent({0, 0, 0, 3, 0, 1}, Index::Open, 1);
  index.Vent({1, 2, 1, 2, 0, 0}, Index::Paint, 3);
  index.Vent({0, 4, 0, 3, 0, 0}, Index::Wall, 3);  // the first vent on a face holds
  index.Vent({4, 4, 0, 3, 0, 1}, Index::Paint, 1); // faces outwards: not seen
  const Walls walls(index);
  EXPECT_EQ(walls.AreaAt(0, true, 0.0), 3.0);
  EXPECT_EQ(walls.Area("PAINT"), 1.0);
  EXPECT_EQ(walls.Area(), 52 - 3);
  EXPECT_FALSE(walls.Builder().FoundMirror());
}

TEST(Walls, AMirrorIsAWall)
{
  Index index = Room();
  index.Vent({0, 0, 0, 3, 0, 2}, Index::Mirror, 1);
  const Walls walls(index);
  EXPECT_TRUE(walls.Builder().FoundMirror());
  EXPECT_EQ(walls.Area("MIRROR"), 6.0);
}

TEST(Walls, ARoundVentTakesTheCellsWhoseCentreItHolds)
{
  Index index;
  index.Mesh("m", {4, 4, 1}, {0, 0, 0}, {4, 4, 1});
  index.CircularVent({0, 4, 0, 4, 0, 0}, Index::Paint, "2.0 2.0 0.0 1.0");
  const Walls walls(index);
  EXPECT_EQ(walls.Area("PAINT"), 4.0); // centres at 0.71 m from the middle; the next are at 1.58 m
}

TEST(Walls, OpeningsOpenAndBlocksVanishInTime)
{
  Index index = Room();
  index.Obstruction({1, 3, 1, 2, 0, 1}, Index::Paint);
  index.Vent({0, 0, 0, 3, 0, 2}, Index::Open, 1);
  index.Text("HIDE_OBST     1\n     1     15.0\nOPEN_VENT     1\n     1     20.0\n");
  EXPECT_EQ(Walls(index, 14.0).Area("PAINT"), 8.0);
  EXPECT_EQ(Walls(index, 15.0).Area("PAINT"), 0.0);
  EXPECT_EQ(Walls(index, 15.0).Area("WALL"), 52.0);
  EXPECT_EQ(Walls(index, 20.0).Area("WALL"), 52.0 - 6.0);
}

TEST(Walls, LetLightThroughGlass)
{
  Index index = Room();
  index.Obstruction({2, 2, 0, 3, 0, 2}, Index::Glass);
  index.Obstruction({0, 1, 0, 1, 0, 1}, Index::Wall, "-3 -1 0.0 0.0 1.0 0.2");
  index.Obstruction({3, 4, 0, 1, 0, 1}, Index::Wall, "-2 -1");
  EXPECT_EQ(Walls(index, 0.0, 0.5).Area(), 52.0);
  EXPECT_EQ(Walls(index, 0.0, 0.3).Area(), 52.0 + 6.0);
  // Each corner block hides three unit faces of the room and shows three of its own.
  EXPECT_EQ(Walls(index, 0.0, 0.0).Area(), 52.0 + 6.0);
  EXPECT_EQ(Walls(index, 0.0, 0.0).AreaAt(2, true, 1.0), 2.0);
  EXPECT_EQ(Walls(index, 0.0, 0.3).AreaAt(2, true, 1.0), 0.0);
}

TEST(Walls, HaveTheirOwnColour)
{
  Index index;
  index.Mesh("m", {1, 1, 3}, {0, 0, 0}, {1, 1, 3});
  index.Obstruction({0, 1, 0, 1, 0, 1}, Index::Paint, "-3 -1 0.25 0.5 0.75 1.0");
  const Walls walls(index);
  std::vector<std::array<double, 3>> colours;
  for (const WallQuad& quad : walls.Quads())
  {
    if (quad.Axis == 2 && quad.Positive)
    {
      colours.push_back(walls.Builder().Materials()[quad.Material].Color);
    }
  }
  EXPECT_THAT(colours, ElementsAre(ElementsAre(0.25, 0.5, 0.75)));
  EXPECT_NEAR(LinearFromSrgb(0.5), 0.21404, 1e-5); // IEC 61966-2-1
  EXPECT_EQ(LinearFromSrgb(0.0), 0.0);
  EXPECT_EQ(LinearFromSrgb(1.0), 1.0);
}

// A room of 4 x 2 x 2 m in two meshes, the second with cells half as wide.
class TwoMeshes : public testing::Test
{
protected:
  void Fine() { index_.Mesh("fine", {4, 4, 4}, {2, 0, 0}, {4, 2, 2}); }
  void Coarse() { index_.Mesh("coarse", {2, 2, 2}, {0, 0, 0}, {2, 2, 2}); }
  Index index_;
};

TEST_F(TwoMeshes, NothingIsBetweenThem)
{
  this->Coarse();
  this->Fine();
  const Walls walls(index_);
  EXPECT_EQ(walls.Area(), 2 * (8 + 8 + 4));
  EXPECT_EQ(walls.AreaAt(0, true, 2.0) + walls.AreaAt(0, false, 2.0), 0.0);
  EXPECT_THAT(walls.Flux(), ElementsAre(0, 0, 0));
}

TEST_F(TwoMeshes, AWallAcrossBothHasNoFaceInside)
{
  this->Coarse();
  index_.Obstruction({1, 2, 0, 1, 0, 2}, Index::Paint); // 1 <= x <= 2, y <= 1
  this->Fine();
  index_.Obstruction({0, 2, 0, 2, 0, 4}, Index::Paint); // 2 <= x <= 3, y <= 1
  const Walls walls(index_);
  EXPECT_EQ(walls.AreaAt(0, true, 2.0) + walls.AreaAt(0, false, 2.0), 0.0);
  EXPECT_EQ(walls.Area("PAINT"), 2 + 2 + 4);
  EXPECT_THAT(walls.Flux(), ElementsAre(0, 0, 0));
}

TEST_F(TwoMeshes, TheFinerOneDecidesWhatPartOfAFaceIsWall)
{
  this->Coarse();
  this->Fine();
  index_.Obstruction({0, 2, 0, 1, 0, 4}, Index::Paint); // y <= 0.5: half a coarse cell
  const Walls walls(index_);
  EXPECT_EQ(walls.AreaAt(0, false, 2.0), 0.5 * 2);
  EXPECT_EQ(walls.Area("PAINT"), 1 + 2 + 1);
  EXPECT_THAT(walls.Flux(), ElementsAre(0, 0, 0));
}

TEST_F(TwoMeshes, ASolidOfTheCoarseOneFacesTheFineOne)
{
  this->Fine();
  this->Coarse();
  index_.Obstruction({1, 2, 0, 1, 0, 2}, Index::Paint);
  const Walls walls(index_);
  EXPECT_EQ(walls.AreaAt(0, true, 2.0), 2.0);
  EXPECT_EQ(walls.AreaAt(0, false, 1.0), 2.0);
  EXPECT_THAT(walls.Flux(), ElementsAre(0, 0, 0));
}

TEST_F(TwoMeshes, APlateBetweenThemIsOneQuad)
{
  this->Coarse();
  index_.Obstruction({2, 2, 0, 2, 0, 1}, Index::Paint);
  this->Fine();
  index_.Obstruction({0, 0, 0, 4, 0, 2}, Index::Paint);
  const Walls walls(index_);
  EXPECT_EQ(walls.AreaAt(0, true, 2.0) + walls.AreaAt(0, false, 2.0), 2.0);
}

TEST_F(TwoMeshes, AFineMeshInsideACoarseOneOverrulesIt)
{
  index_.Mesh("around", {4, 4, 4}, {0, 0, 0}, {4, 4, 4});
  index_.Obstruction({1, 3, 1, 3, 1, 2}, Index::Inert); // inside the fine mesh: not believed
  index_.Mesh("inside", {4, 4, 4}, {1, 1, 1}, {3, 3, 3});
  index_.Obstruction({0, 4, 0, 4, 0, 1}, Index::Paint); // a slab of 2 x 2 x 0.5
  const Walls walls(index_);
  EXPECT_EQ(walls.Area("INERT"), 0.0);
  EXPECT_EQ(walls.Area("WALL"), 6 * 16.0);
  EXPECT_EQ(walls.AreaAt(2, true, 1.5), 4.0);
  EXPECT_EQ(walls.AreaAt(2, false, 1.0), 4.0);
  EXPECT_THAT(walls.Flux(), ElementsAre(0, 0, 0));
}

TEST(SolidCells, MarksBlocksButNotPlates)
{
  Index index = Room();
  index.Obstruction({1, 3, 1, 2, 0, 1}, Index::Wall);
  index.Obstruction({0, 0, 0, 3, 0, 2}, Index::Wall);
  test::Folder folder("solid");
  const SmvFile run(folder.Write("test.smv", index.Bytes()));
  const auto solid = SolidCells(run.Meshes[0], {0, 1});
  ASSERT_EQ(solid.size(), 24U);
  for (std::size_t cell = 0; cell < solid.size(); ++cell)
  {
    EXPECT_EQ(solid[cell], cell == 5 || cell == 6 ? 1 : 0) << cell;
  }
  EXPECT_TRUE(SolidCells(run.Meshes[0], {1}).empty());
}

} // namespace smokevis
