#include "PlateStencil.h"

#include "Emitters.h"
#include "GaussNodes.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/constants.hpp>

namespace smokevis
{

namespace
{

/// Largest half-length over distance that so many places across, from the fewest, serve. No round
/// numbers: no receiver of a regular scene is at a limit, where rounding would decide.
constexpr std::array<double, 3> LargestRatios = {0.1017, 0.2183, 0.3679};

std::vector<double> ChebyshevNodes(int count)
{
  std::vector<double> nodes;
  for (int i = 0; i < count; ++i)
  {
    nodes.push_back(0.5 - 0.5 * std::cos(glm::pi<double>() * (i + 0.5) / count));
  }
  return nodes;
}

/// Values at t of the polynomials that are 1 at one node and 0 at the others.
std::vector<double> LagrangeWeights(const std::vector<double>& nodes, double t)
{
  std::vector<double> weights(nodes.size(), 1.0);
  for (std::size_t i = 0; i < nodes.size(); ++i)
  {
    for (std::size_t j = 0; j < nodes.size(); ++j)
    {
      weights[i] *= i == j ? 1.0 : (t - nodes[j]) / (nodes[i] - nodes[j]);
    }
  }
  return weights;
}

} // namespace

PlateStencil::PlateStencil(
  const std::array<Vec3, 4>& corners, std::span<const LightGroup> leaves, int bands)
    : Centre_(0.5 * (corners[0] + corners[2]))
{
  const Vec3 along = corners[1] - corners[0];
  const Vec3 up = corners[3] - corners[0];
  this->Half_ = 0.5 * std::max(glm::length(along), glm::length(up));
  for (int count = FewestAcross; count <= MostAcross; ++count)
  {
    const std::vector<double> nodes = ChebyshevNodes(count);
    std::vector<Place>& places = this->Places_[count - FewestAcross];
    for (int j = 0; j < count; ++j)
    {
      for (int i = 0; i < count; ++i)
      {
        places.push_back({corners[0] + nodes[i] * along + nodes[j] * up, {}});
      }
    }
    // Four Gauss points an edge are exact for these polynomials on any leaf.
    for (const LightGroup& leaf : leaves)
    {
      for (std::size_t point = 0; point < Nodes4.size() * Nodes4.size(); ++point)
      {
        const std::size_t row = point / Nodes4.size();
        const std::size_t column = point % Nodes4.size();
        const Vec3 at = leaf.At(Nodes4[column], Nodes4[row]) - corners[0];
        const double share =
          Weights4[column] * Weights4[row] * leaf.AreaAt(Nodes4[column], Nodes4[row]) / leaf.Area;
        const auto u = LagrangeWeights(nodes, glm::dot(at, along) / glm::dot(along, along));
        const auto v = LagrangeWeights(nodes, glm::dot(at, up) / glm::dot(up, up));
        for (std::size_t place = 0; place < places.size(); ++place)
        {
          const double weight = share * u[place % nodes.size()] * v[place / nodes.size()];
          for (int band = 0; band < bands; ++band)
          {
            places[place].Intensity[band] += weight * leaf.Intensity[band];
          }
        }
      }
    }
  }
}

std::span<const PlateStencil::Place> PlateStencil::PlacesFor(
  const Vec3& receiver, double sharpness) const
{
  const double ratio = sharpness * this->Half_ / glm::length(this->Centre_ - receiver);
  for (std::size_t i = 0; i < LargestRatios.size(); ++i)
  {
    if (ratio <= LargestRatios[i])
    {
      return this->Places_[i];
    }
  }
  return {};
}

} // namespace smokevis
