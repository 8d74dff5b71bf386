// Traces the pixels of an image in parallel.
#include "ImageTracer.h"

#include "Errors.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>

namespace smokevis
{
namespace
{

/// Samples along each side of a pixel whose whole footprint lies on plates: only the pattern
/// varies.
constexpr int PatternSamples = 8;
/// Samples along each side of a pixel at the edge of a plate: rays of other lengths, in all smoke.
constexpr int EdgeSamples = 4;
/// Distances that differ by less than this share have the same smoke before them.
constexpr double SameDistance = 0.01;

/// What one band of a pixel receives.
struct PixelLight
{
  double Surface = 0.0;
  double Veil = 0.0;
  double OpticalDepth = 0.0;
  Lanes Multiple;

  void Add(const RayLight& light, double weight)
  {
    this->Surface += weight * std::max(0.0, light.Surface);
    this->Veil += weight * light.Veil();
    this->OpticalDepth += weight * light.OpticalDepth;
    this->AddMultiple(light.SurfaceMultiple, weight);
    this->AddMultiple(light.VeilMultiple, weight);
  }

  void AddMultiple(const Lanes& lanes, double weight)
  {
    for (int batch = 0; batch < Batches; ++batch)
    {
      this->Multiple[batch] += static_cast<float>(weight) * lanes[batch];
    }
  }
};

class PixelTracer
{
public:
  PixelTracer(const View& view, const Camera& camera, double acuity, TracedImage& image)
      : View_(view), Camera_(camera), Image_(image), Acuity_(acuity),
        Bands_(view.TheScene().Bands())
  {
  }

  void Trace(std::size_t pixel) const
  {
    const int width = this->Camera_.Width;
    const double x = static_cast<double>(pixel % width) + 0.5;
    const double y = static_cast<double>(pixel / width) + 0.5;
    const Vec3 direction = this->Camera_.Direction(x, y);
    const Hit hit = this->View_.FirstHit(this->Camera_.Position, direction);
    PixelLight light[MaxBands];
    switch (this->Look(x, y, hit))
    {
    case Content::Even:
      for (int band = 0; band < this->Bands_; ++band)
      {
        light[band].Add(this->View_.Trace(this->Camera_.Position, direction, hit, band), 1.0);
      }
      break;
    case Content::Pattern:
      this->AveragePattern(x, y, direction, hit, light);
      break;
    case Content::Edge:
      this->AverageRays(x, y, light);
      break;
    }
    this->Put(pixel, light);
    this->Image_.SignIds[pixel] = -1;
    if (hit.Found() && hit.Emitter && hit.Side == 0)
    {
      this->Image_.SignIds[pixel] = this->Emitter(hit).SignId;
    }
  }

private:
  enum class Content
  {
    /// No plate, or one cell of a plate.
    Even,
    /// Cells of plates at one distance.
    Pattern,
    /// Plates and what is beside them.
    Edge
  };

  const EmitterCell& Emitter(const Hit& hit) const
  {
    return this->View_.TheScene().Lights().Cells()[this->Index(hit)];
  }

  std::size_t Index(const Hit& hit) const { return this->View_.TheScene().Shapes().Cell(hit); }

  /// Half the side of a pixel's footprint, in pixels.
  double HalfFootprint(double x, double y) const
  {
    const Vec3 step = this->Camera_.Direction(x + 0.5, y) - this->Camera_.Direction(x - 0.5, y);
    return 0.5 * std::max(1.0, this->Acuity_ / std::max(glm::length(step), 1e-12));
  }

  Content Look(double x, double y, const Hit& centre) const
  {
    const double half = this->HalfFootprint(x, y);
    int plates = centre.Emitter && centre.Found() ? 1 : 0;
    bool oneCell = plates == 1;
    bool oneDistance = true;
    for (int corner = 0; corner < 4; ++corner)
    {
      const Hit hit = this->View_.FirstHit(
        this->Camera_.Position, this->Camera_.Direction(x + (corner % 2 == 0 ? -half : half),
                                  y + (corner / 2 == 0 ? -half : half)));
      const bool plate = hit.Found() && hit.Emitter;
      plates += plate ? 1 : 0;
      oneCell =
        oneCell && plate && this->Index(hit) == this->Index(centre) && hit.Side == centre.Side;
      oneDistance =
        oneDistance && std::abs(hit.Distance - centre.Distance) <= SameDistance * centre.Distance;
    }
    // A cell is convex: one that holds the corners of the footprint holds all of it.
    return plates == 0 || oneCell       ? Content::Even
           : plates == 5 && oneDistance ? Content::Pattern
                                        : Content::Edge;
  }

  template <class Visit> void ForEachSample(double x, double y, int samples, Visit&& visit) const
  {
    const double side = 2.0 * this->HalfFootprint(x, y);
    for (int j = 0; j < samples; ++j)
    {
      for (int i = 0; i < samples; ++i)
      {
        const Vec3 direction = this->Camera_.Direction(
          x + side * ((i + 0.5) / samples - 0.5), y + side * ((j + 0.5) / samples - 0.5));
        visit(direction, this->View_.FirstHit(this->Camera_.Position, direction));
      }
    }
  }

  /// The smoke is that of the middle of the pixel, the pattern the mean over the footprint.
  void AveragePattern(
    double x, double y, const Vec3& direction, const Hit& hit, PixelLight light[]) const
  {
    double transmittance[MaxBands];
    for (int band = 0; band < this->Bands_; ++band)
    {
      const RayLight veil =
        this->View_.TraceVeil(this->Camera_.Position, direction, 0.0, hit.Distance, band);
      light[band].Add(veil, 1.0);
      transmittance[band] = std::exp(-veil.OpticalDepth);
    }
    const double weight = 1.0 / (PatternSamples * PatternSamples);
    this->ForEachSample(x, y, PatternSamples,
      [&](const Vec3& ray, const Hit& end)
      {
        for (int band = 0; band < this->Bands_; ++band)
        {
          Lanes lanes;
          double surface = 0.0;
          if (end.Found() && end.Emitter)
          {
            surface = transmittance[band] * this->View_.EmitterLuminance(this->Index(end), end.Side,
                                              this->Camera_.Position + end.Distance * ray, -ray,
                                              band, lanes);
            light[band].AddMultiple(lanes, weight * transmittance[band]);
          }
          else
          {
            // Something thin before the plate, or a slit in it.
            const RayLight other = this->View_.Trace(this->Camera_.Position, ray, end, band);
            surface = other.Surface;
            light[band].AddMultiple(other.SurfaceMultiple, weight);
          }
          light[band].Surface += weight * surface;
        }
      });
  }

  void AverageRays(double x, double y, PixelLight light[]) const
  {
    const double weight = 1.0 / (EdgeSamples * EdgeSamples);
    this->ForEachSample(x, y, EdgeSamples,
      [&](const Vec3& ray, const Hit& end)
      {
        for (int band = 0; band < this->Bands_; ++band)
        {
          light[band].Add(this->View_.Trace(this->Camera_.Position, ray, end, band), weight);
        }
      });
  }

  void Put(std::size_t pixel, const PixelLight light[]) const
  {
    Spectrum surface{}, veil{};
    Lanes multiple;
    for (int band = 0; band < this->Bands_; ++band)
    {
      surface[band] = light[band].Surface;
      veil[band] = light[band].Veil;
      const double weight = this->Bands_ == 1 ? 1.0 : PhotopicWeights[band];
      for (int batch = 0; batch < Batches; ++batch)
      {
        multiple[batch] += static_cast<float>(weight) * light[band].Multiple[batch];
      }
    }
    const double direct = smokevis::Luminance(surface, this->Bands_);
    const double added = smokevis::Luminance(veil, this->Bands_);
    this->Image_.Luminance[pixel] = static_cast<float>(direct + added);
    this->Image_.LuminanceError[pixel] = static_cast<float>(StandardError(multiple));
    this->Image_.Direct[pixel] = static_cast<float>(direct);
    this->Image_.Veil[pixel] = static_cast<float>(added);
    this->Image_.OpticalDepth[pixel] =
      static_cast<float>(light[this->Bands_ == 1 ? 0 : 1].OpticalDepth);
    for (int band = 0; band < MaxBands; ++band)
    {
      const int from = std::min(band, this->Bands_ - 1);
      this->Image_.LuminanceRGB[3 * pixel + band] = static_cast<float>(surface[from] + veil[from]);
    }
  }

  const View& View_;
  const Camera& Camera_;
  TracedImage& Image_;
  double Acuity_;
  int Bands_;
};

} // namespace

//------------------------------------------------------------------------------
TracedImage TraceImage(const View& view, const Camera& camera, double acuity, Progress& progress)
{
  const std::size_t pixels = static_cast<std::size_t>(camera.Width) * camera.Height;
  TracedImage image;
  for (auto* const values :
    {&image.Luminance, &image.LuminanceError, &image.Direct, &image.Veil, &image.OpticalDepth})
  {
    values->resize(pixels);
  }
  image.LuminanceRGB.resize(3 * pixels);
  image.SignIds.resize(pixels);

  const PixelTracer tracer(view, camera, acuity, image);
  const std::thread::id caller = std::this_thread::get_id();
  std::atomic<std::size_t> done{0};
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, pixels, 16),
    [&](const tbb::blocked_range<std::size_t>& range)
    {
      for (std::size_t pixel = range.begin(); pixel < range.end(); ++pixel)
      {
        if (progress.ShouldStop())
        {
          return;
        }
        tracer.Trace(pixel);
      }
      const std::size_t count = done.fetch_add(range.size(), std::memory_order_relaxed);
      if (std::this_thread::get_id() == caller)
      {
        progress.Report(static_cast<double>(count) / static_cast<double>(pixels));
      }
    });
  if (progress.ShouldStop())
  {
    throw Error("image", "it was stopped before it was finished");
  }
  return image;
}

} // namespace smokevis
