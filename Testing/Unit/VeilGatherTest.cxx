// The veil gathered along rays through a light field that is known.
#include "VeilGather.h"
#include "View.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;

constexpr double SkyLuminance = 3.0;

/// White smoke of changing density under an even sky.
SceneDescription WhiteCloud()
{
  SceneDescription description;
  SmokeGrid grid;
  grid.Name = "cloud";
  grid.Nodes = {{{0.0, 1.0, 2.5, 3.0}, {0.0, 1.0, 2.0}, {0.0, 1.0}}};
  grid.Extinction = {0.2F, 3.0F, 0.7F, 0.0F, 1.5F, 0.4F};
  description.Albedo = 1.0;
  description.Sky = SkyLuminance;
  description.Grids = {grid};
  return description;
}

/// A field of that scene with the same fluence everywhere, all of it multiply scattered.
std::shared_ptr<LightField> EvenField(const Scene& scene, double fluence)
{
  auto field = std::make_shared<LightField>();
  field->Cells = scene.Smoke().Cells();
  field->Patches = scene.Patches();
  field->DirectFluence.assign(field->Cells, 0.0F);
  Lanes even;
  std::fill(std::begin(even.Value), std::end(even.Value), static_cast<float>(fluence));
  field->MultipleFluence.assign(field->Cells, even);
  field->DirectIlluminance.assign(2 * field->Patches, 0.0F);
  field->MultipleIlluminance.assign(2 * field->Patches, Lanes());
  return field;
}

// Smoke that loses nothing under an even sky is as bright as the sky in all directions, whatever
// its density: the veil hides the share of the sky that it takes the place of.
TEST(VeilGather, WhiteCloudUnderEvenSky)
{
  const auto scene = std::make_shared<const Scene>(WhiteCloud());
  const View view(scene, EvenField(*scene, 4.0 * std::numbers::pi * SkyLuminance));
  const Vec3 origin(-0.5, 0.3, 0.4);
  const Vec3 direction = glm::normalize(Vec3(1.0, 0.3, 0.05));
  for (const double end : {1.0, 2.2, 9.0})
  {
    const double depth = scene->Smoke().OpticalDepth(origin, direction, 0.0, end);
    const GatheredVeil veil = view.GatherVeil(origin, {{direction, end}}, 0);
    EXPECT_GT(veil.Rays, 0U);
    for (int batch = 0; batch < Batches; ++batch)
    {
      EXPECT_NEAR(veil.Multiple[batch] / (SkyLuminance * -std::expm1(-depth)), 1.0, 2e-6)
        << "end " << end << ", batch " << batch;
    }
  }
}

// A field that is dark but for the sky sends on what the sky sends it: light of the first order
// through a thin cloud is the sky's, less what the cloud takes of it.
TEST(VeilGather, FindsLightThatTheFieldDoesNotKnow)
{
  SceneDescription description = WhiteCloud();
  for (float& extinction : description.Grids[0].Extinction)
  {
    extinction *= 1e-4F;
  }
  const auto scene = std::make_shared<const Scene>(description);
  const View view(scene, EvenField(*scene, 0.0));
  const Vec3 origin(-0.5, 0.3, 0.4);
  const Vec3 direction(1.0, 0.0, 0.0);
  const double depth = scene->Smoke().OpticalDepth(origin, direction, 0.0, 9.0);
  const GatheredVeil veil = view.GatherVeil(origin, {{direction, 9.0}}, 0);
  EXPECT_NEAR(Mean(veil.Multiple) / (SkyLuminance * depth), 1.0, 1e-3);
}

// The mean over two lines of sight, of which one leads into the cloud and one away from it.
TEST(VeilGather, MeanOverLines)
{
  const auto scene = std::make_shared<const Scene>(WhiteCloud());
  const View view(scene, EvenField(*scene, 4.0 * std::numbers::pi * SkyLuminance));
  const Vec3 origin(-0.5, 0.3, 0.4);
  const Vec3 direction(1.0, 0.0, 0.0);
  const double depth = scene->Smoke().OpticalDepth(origin, direction, 0.0, 9.0);
  const GatheredVeil veil =
    view.GatherVeil(origin, {{direction, 9.0, 0.3}, {-direction, 9.0, 0.7}}, 0);
  EXPECT_NEAR(Mean(veil.Multiple) / (0.3 * SkyLuminance * -std::expm1(-depth)), 1.0, 2e-6);
}

// Rays of the same line through the same light are the same, those through light of which one batch
// is another are not.
TEST(VeilGather, RaysBelongToTheField)
{
  const auto scene = std::make_shared<const Scene>(WhiteCloud());
  const std::vector<SightLine> line = {{{1.0, 0.0, 0.0}, 9.0}};
  const Vec3 origin(-0.5, 0.3, 0.4);
  const auto gathered = [&](double ofFirstBatch)
  {
    const std::shared_ptr<LightField> field = EvenField(*scene, 1.0);
    for (Lanes& lanes : field->MultipleFluence)
    {
      lanes[0] = static_cast<float>(ofFirstBatch);
    }
    return View(scene, field).GatherVeil(origin, line, 0).Multiple;
  };
  const Lanes first = gathered(1.0);
  const Lanes again = gathered(1.0);
  const Lanes other = gathered(1.1);
  EXPECT_GT(StandardError(first), 0.0);
  EXPECT_EQ(first[0], again[0]);
  for (int batch = 1; batch < Batches; ++batch)
  {
    EXPECT_EQ(first[batch], again[batch]);
    EXPECT_GT(std::abs(other[batch] - first[batch]), 1e-5F * first[batch]);
  }
}

// Where no smoke scatters there is nothing to gather.
TEST(VeilGather, NothingInClearAir)
{
  const auto scene = std::make_shared<const Scene>(WhiteCloud());
  const View view(scene, EvenField(*scene, 1.0));
  const GatheredVeil none = view.GatherVeil({-0.5, 0.3, 0.4}, {{{-1.0, 0.0, 0.0}, 9.0}}, 0);
  EXPECT_EQ(none.Rays, 0U);
  EXPECT_EQ(Mean(none.Multiple), 0.0);
}

} // namespace
