// Traces the pixels of an image in parallel.
#include "ImageTracer.h"

#include "Errors.h"
#include "PixelLight.h"
#include "ReportedLoop.h"
#include "SmallPlates.h"
#include "Team.h"
#include "VeilBlock.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace smokevis
{
namespace
{

/// Side of the squares of pixels that are traced together.
constexpr int BlockSize = 32;
/// Samples along each side of a pixel that shows plates only: their pattern may be fine.
constexpr int PatternSamples = 8;
/// Samples along each side of a pixel at the edge of a plate.
constexpr int EdgeSamples = 4;
/// Points of the lens that an image with depth of field is averaged over.
constexpr int LensSamples = 64;
/// Distances that differ by less than this share have the same smoke before them.
constexpr double SameDistance = 0.01;

bool SeemsAsFar(const Hit& first, const Hit& second)
{
  return first.Found() == second.Found() &&
         (!first.Found() ||
           std::abs(first.Distance - second.Distance) <= SameDistance * first.Distance);
}

bool ShowsPlate(const Hit& hit)
{
  return hit.Found() && hit.Emitter;
}

/// Traces squares of pixels.
class BlockTracer
{
public:
  BlockTracer(const View& view, const Camera& camera, double acuity, TracedImage& image)
      : View_(view), Camera_(camera), Image_(image), Small_(view, camera, acuity), Acuity_(acuity),
        Bands_(view.TheScene().Bands())
  {
  }

  /// Traces the pixels from (x, y) on. Returns how many of them are means of samples.
  std::size_t Trace(int x, int y) const
  {
    const int columns = std::min(BlockSize, this->Camera_.Width - x);
    const int rows = std::min(BlockSize, this->Camera_.Height - y);
    // A row and a column of the next blocks support the interpolation at the border.
    const int width = std::min(columns + 1, this->Camera_.Width - x);
    const int height = std::min(rows + 1, this->Camera_.Height - y);
    VeilBlock veil(this->View_, this->Camera_, x, y, width, height);
    std::vector<Pixel> pixels(static_cast<std::size_t>(width) * height);
    for (int row = 0; row < height; ++row)
    {
      for (int column = 0; column < width; ++column)
      {
        Pixel& pixel = pixels[row * width + column];
        pixel = this->Look(x + column + 0.5, y + row + 0.5);
        veil.SetDistance(column, row, pixel.Seen.Distance);
      }
    }
    veil.Compute();
    std::size_t averaged = 0;
    for (int row = 0; row < rows; ++row)
    {
      for (int column = 0; column < columns; ++column)
      {
        const Pixel& pixel = pixels[row * width + column];
        this->Shade(x + column, y + row, pixel, veil.Get(column, row));
        averaged += pixel.Samples > 1 ? 1 : 0;
      }
    }
    return averaged;
  }

private:
  struct Pixel
  {
    Hit Seen;
    /// Samples along each side of its footprint.
    int Samples = 1;
    /// False where parts of the footprint have other smoke before them than the middle.
    bool OneDistance = true;
  };

  std::size_t Emitter(const Hit& hit) const { return this->View_.TheScene().Shapes().Cell(hit); }

  /// Half the side of a pixel's footprint, in pixels.
  double HalfFootprint(double x, double y) const
  {
    const Vec3 step = this->Camera_.Direction(x + 0.5, y) - this->Camera_.Direction(x - 0.5, y);
    return 0.5 * std::max(1.0, this->Acuity_ / std::max(glm::length(step), 1e-12));
  }

  Pixel Look(double x, double y) const
  {
    Pixel pixel;
    pixel.Seen = this->View_.FirstHit(this->Camera_.Position, this->Camera_.Direction(x, y));
    const double half = this->HalfFootprint(x, y);
    int plates = ShowsPlate(pixel.Seen) ? 1 : 0;
    bool oneCell = plates == 1;
    for (int corner = 0; corner < 4; ++corner)
    {
      const Hit hit = this->View_.FirstHit(
        this->Camera_.Position, this->Camera_.Direction(x + (corner % 2 == 0 ? -half : half),
                                  y + (corner / 2 == 0 ? -half : half)));
      plates += ShowsPlate(hit) ? 1 : 0;
      oneCell = oneCell && ShowsPlate(hit) && hit.Side == pixel.Seen.Side &&
                this->Emitter(hit) == this->Emitter(pixel.Seen);
      pixel.OneDistance = pixel.OneDistance && SeemsAsFar(pixel.Seen, hit);
    }
    // A cell is convex: one that holds the corners of the footprint holds all of it.
    if (plates == 0 || oneCell)
    {
      pixel.OneDistance = true;
    }
    else
    {
      pixel.Samples = plates == 5 ? PatternSamples : EdgeSamples;
    }
    return pixel;
  }

  /// Luminance that leaves what a ray meets towards the eye, and its batches, before any smoke.
  double SurfaceLuminance(const Vec3& ray, const Hit& hit, int band, Lanes& lanes) const
  {
    lanes = Lanes();
    if (!hit.Found())
    {
      return this->View_.TheScene().Sky();
    }
    const Vec3 point = this->Camera_.Position + hit.Distance * ray;
    if (hit.Emitter)
    {
      return this->View_.EmitterLuminance(this->Emitter(hit), hit.Side, point, -ray, band, lanes);
    }
    // A ray that starts right before the surface.
    Hit near = hit;
    near.Distance = 1e-9 * hit.Distance;
    const RayLight light = this->View_.Trace(point - near.Distance * ray, ray, near, band);
    lanes = light.SurfaceMultiple;
    return std::max(0.0, light.Surface);
  }

  void AddSample(const Vec3& ray, const Hit& hit, const VeilBlock::Smoke& smoke, double weight,
    PixelSpectrum& light) const
  {
    for (int band = 0; band < this->Bands_; ++band)
    {
      Lanes lanes;
      const double transmitted = weight * std::exp(-smoke[band].OpticalDepth);
      light[band].Surface += transmitted * this->SurfaceLuminance(ray, hit, band, lanes);
      Add(light[band].Multiple, lanes, static_cast<float>(transmitted));
      light[band].AddVeil(smoke[band], weight);
    }
  }

  void Shade(int column, int row, const Pixel& pixel, const VeilBlock::Smoke& smoke) const
  {
    const double x = column + 0.5;
    const double y = row + 0.5;
    const std::size_t index = column + static_cast<std::size_t>(row) * this->Camera_.Width;
    const double share = this->Small_.Share(index);
    PixelSpectrum light;
    bool background = true;
    if (pixel.Samples == 1)
    {
      this->AddSample(this->Camera_.Direction(x, y), pixel.Seen, smoke, 1.0, light);
    }
    else
    {
      background = this->Average(x, y, pixel, smoke, share > 0.0, light);
    }
    if (share > 0.0)
    {
      for (PixelLight& band : light)
      {
        band.Scale(1.0 - share);
      }
      this->Small_.Add(index, light);
      for (PixelLight& band : light)
      {
        band.Scale(background ? 1.0 : 1.0 / share);
      }
    }
    this->Put(index, light);
    this->Image_.SignIds[index] =
      ShowsPlate(pixel.Seen) && pixel.Seen.Side == 0
        ? this->View_.TheScene().Lights().Cells()[this->Emitter(pixel.Seen)].SignId
        : this->Small_.SignAt(index);
  }

  /// Mean over a regular grid of samples. Samples as far away as each other share their smoke.
  /// @param behind whether small plates are left out; false is returned where nothing else is seen
  bool Average(double x, double y, const Pixel& pixel, const VeilBlock::Smoke& smoke, bool behind,
    PixelSpectrum& light) const
  {
    struct Sheet
    {
      Hit Seen;
      VeilBlock::Smoke Smoke;
    };
    std::vector<Sheet> sheets;
    if (pixel.OneDistance)
    {
      sheets.push_back({pixel.Seen, smoke});
    }
    int seen = 0;
    const auto add = [&](double right, double up)
    {
      const Vec3 ray = this->Camera_.Direction(x + right, y + up);
      const Hit hit = this->View_.FirstHit(this->Camera_.Position, ray);
      if (behind && this->Small_.Covers(hit))
      {
        return;
      }
      auto sheet = std::find_if(sheets.begin(), sheets.end(),
        [&](const Sheet& known) { return SeemsAsFar(known.Seen, hit); });
      if (sheet == sheets.end())
      {
        sheets.push_back({hit, {}});
        sheet = sheets.end() - 1;
        for (int band = 0; band < this->Bands_; ++band)
        {
          sheet->Smoke[band] =
            this->View_.TraceVeil(this->Camera_.Position, ray, 0.0, hit.Distance, band);
        }
      }
      this->AddSample(ray, hit, sheet->Smoke, 1.0, light);
      ++seen;
    };
    const int count = pixel.Samples;
    const double side = 2.0 * this->HalfFootprint(x, y);
    for (int j = 0; j < count; ++j)
    {
      for (int i = 0; i < count; ++i)
      {
        add(side * ((i + 0.5) / count - 0.5), side * ((j + 0.5) / count - 0.5));
      }
    }
    // A convex plate that leaves something of the pixel leaves a corner.
    for (int corner = 0; seen == 0 && corner < 4; ++corner)
    {
      add((corner % 2 == 0 ? -0.5 : 0.5) * side, (corner / 2 == 0 ? -0.5 : 0.5) * side);
    }
    for (PixelLight& band : light)
    {
      band.Scale(1.0 / std::max(1, seen));
    }
    return seen > 0;
  }

  void Put(std::size_t pixel, const PixelSpectrum& light) const
  {
    Spectrum surface{}, veil{};
    Lanes multiple;
    for (int band = 0; band < this->Bands_; ++band)
    {
      surface[band] = light[band].Surface;
      veil[band] = light[band].Veil;
      Add(multiple, light[band].Multiple,
        this->Bands_ == 1 ? 1.0F : static_cast<float>(PhotopicWeights[band]));
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
  SmallPlates Small_;
  double Acuity_;
  int Bands_;
};

/// The squares of pixels that an image is traced in.
struct Squares
{
  explicit Squares(const Camera& camera)
      : Columns((camera.Width + BlockSize - 1) / BlockSize),
        Count(static_cast<std::size_t>(Columns) * ((camera.Height + BlockSize - 1) / BlockSize))
  {
  }

  /// First pixel of a square.
  int X(std::size_t square) const { return static_cast<int>(square % this->Columns) * BlockSize; }
  int Y(std::size_t square) const { return static_cast<int>(square / this->Columns) * BlockSize; }

  std::size_t Columns;
  std::size_t Count;
};

/// The squares of this process.
TracedImage TracePinhole(
  const View& view, const Camera& camera, double acuity, const Team& team, Progress& progress)
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

  const BlockTracer tracer(view, camera, acuity, image);
  const Squares squares(camera);
  std::atomic<std::size_t> averaged{0};
  tbb::task_arena arena{tbb::task_arena::attach()};
  ReportedLoop(
    arena, team.OwnCount(squares.Count), 1, progress,
    [&progress](double done) { progress.Report(done); },
    [&](std::size_t i)
    {
      const std::size_t square = team.OwnItem(i);
      averaged.fetch_add(
        tracer.Trace(squares.X(square), squares.Y(square)), std::memory_order_relaxed);
    });
  progress.ThrowIfStopped("image");
  image.Averaged = averaged;
  return image;
}

/// Progress of one of several equal parts of the work.
class PartProgress : public Progress
{
public:
  PartProgress(Progress& whole, int part, int parts) : Whole_(whole), Part_(part), Parts_(parts) {}

  void Report(double fraction) override
  {
    this->Whole_.Report((this->Part_ + fraction) / this->Parts_);
    if (this->Whole_.ShouldStop())
    {
      this->Stop();
    }
  }

private:
  Progress& Whole_;
  int Part_;
  int Parts_;
};

std::array<std::vector<float>*, 6> Channels(TracedImage& image)
{
  return {&image.Luminance, &image.LuminanceError, &image.Direct, &image.Veil, &image.OpticalDepth,
    &image.LuminanceRGB};
}

void AddTo(std::vector<float>& sum, const std::vector<float>& values)
{
  std::transform(
    sum.begin(), sum.end(), values.begin(), sum.begin(), [](float a, float b) { return a + b; });
}

/// The mean of pinhole cameras all over the lens; the squares of this process.
TracedImage TraceLens(
  const View& view, const Camera& camera, double acuity, const Team& team, Progress& progress)
{
  Camera centre = camera;
  centre.Aperture = 0.0;
  PartProgress first(progress, 0, LensSamples + 1);
  TracedImage image = TracePinhole(view, centre, acuity, team, first);
  for (std::vector<float>* const values : Channels(image))
  {
    std::fill(values->begin(), values->end(), 0.0F);
  }
  for (int point = 0; point < LensSamples; ++point)
  {
    PartProgress part(progress, point + 1, LensSamples + 1);
    TracedImage sample =
      TracePinhole(view, camera.ThroughLens(point, LensSamples), acuity, team, part);
    for (std::size_t i = 0; i < Channels(image).size(); ++i)
    {
      AddTo(*Channels(image)[i], *Channels(sample)[i]);
    }
  }
  for (std::vector<float>* const values : Channels(image))
  {
    for (float& value : *values)
    {
      value /= static_cast<float>(LensSamples);
    }
  }
  image.LensPoints = LensSamples;
  return image;
}

/// Completes the pixels with those of the other processes.
void Complete(TracedImage& image, const Camera& camera, Team& team)
{
  const Squares squares(camera);
  const auto complete = [&](auto& values)
  {
    using Value = typename std::decay_t<decltype(values)>::value_type;
    const std::size_t components =
      values.size() / (static_cast<std::size_t>(camera.Width) * camera.Height);
    team.Complete<Value>(squares.Count,
      [&](std::size_t square, auto&& take)
      {
        const int right = std::min(camera.Width, squares.X(square) + BlockSize);
        const int top = std::min(camera.Height, squares.Y(square) + BlockSize);
        for (int y = squares.Y(square); y < top; ++y)
        {
          const std::size_t row = static_cast<std::size_t>(y) * camera.Width;
          for (std::size_t i = components * (row + squares.X(square));
               i < components * (row + right); ++i)
          {
            take(values[i]);
          }
        }
      });
  };
  for (std::vector<float>* const values : Channels(image))
  {
    complete(*values);
  }
  complete(image.SignIds);
}

} // namespace

//------------------------------------------------------------------------------
TracedImage TraceImage(
  const View& view, const Camera& camera, double acuity, Team& team, Progress& progress)
{
  const std::size_t cutBefore = view.RaysCutShort();
  TracedImage image = camera.Aperture > 0.0 ? TraceLens(view, camera, acuity, team, progress)
                                            : TracePinhole(view, camera, acuity, team, progress);
  Complete(image, camera, team);
  image.Averaged = team.Sum(image.Averaged);
  image.CutShort = team.Sum(view.RaysCutShort() - cutBefore);
  return image;
}

} // namespace smokevis
