// Areas and centroids of what is left of clipped polygons.
#include "PolygonClip.h"

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;

void ExpectMiddle(const FlatPolygon& polygon, const glm::dvec2& middle)
{
  EXPECT_LT(glm::length(MiddleOf(polygon) - middle), 1e-12)
    << MiddleOf(polygon).x << " " << MiddleOf(polygon).y;
}

// That of a trapezoid lies (2 a + b) / (a + b) / 3 of its height above the side b.
TEST(PolygonClip, CentroidOfWhatIsLeft)
{
  ExpectMiddle({{0, 0}, {2, 0}, {2, 1}, {0, 1}}, {1.0, 0.5});
  ExpectMiddle({{0, 0}, {3, 0}, {0, 3}}, {1.0, 1.0});
  ExpectMiddle({{-2, 0}, {2, 0}, {1, 3}, {-1, 3}}, {0.0, (2.0 * 2.0 + 4.0) / (2.0 + 4.0)});
}

// Clipping may leave a corner twice, by rounding, and polygons turn either way.
TEST(PolygonClip, CentroidIgnoresDoubledCorners)
{
  ExpectMiddle({{0, 0}, {2, 0}, {2, 0}, {2, 1}, {2, 1}, {0, 1}, {0, 0}}, {1.0, 0.5});
  ExpectMiddle({{0, 0}, {2, 0}, {2, 1e-17}, {2, 1}, {0, 1}}, {1.0, 0.5});
  ExpectMiddle({{0, 1}, {2, 1}, {2, 0}, {0, 0}}, {1.0, 0.5});
  ExpectMiddle({{0.3, 0.7}, {0.3, 0.7}, {0.3, 0.7}}, {0.3, 0.7});
}

} // namespace
