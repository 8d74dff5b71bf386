#include "Roughness.h"

#include <cmath>

#include <Eigen/QR>

namespace smokevis
{

double Roughness(const std::vector<SeenPlace>& places, const std::vector<double>& values)
{
  const auto count = static_cast<Eigen::Index>(places.size());
  constexpr int Terms = 6;
  Eigen::Matrix<double, Eigen::Dynamic, Terms> terms(count, Terms);
  Eigen::VectorXd weighted(count);
  double weights = 0.0;
  for (Eigen::Index i = 0; i < count; ++i)
  {
    const SeenPlace& place = places[i];
    const double weight = std::sqrt(place.Weight);
    const double u = place.OnPlate.x;
    const double v = place.OnPlate.y;
    terms.row(i) << weight, weight * u, weight * v, weight * u * u, weight * u * v, weight * v * v;
    weighted[i] = weight * values[i];
    weights += place.Weight;
  }
  if (!(weights > 0.0))
  {
    return 0.0;
  }
  const Eigen::Vector<double, Terms> factors = terms.colPivHouseholderQr().solve(weighted);
  return std::sqrt((terms * factors - weighted).squaredNorm() / weights);
}

} // namespace smokevis
