// Reads the PNG file that a sign's pattern comes from. libpng is used directly: VTK's reader
// crashes on damaged files.
#include "Errors.h"
#include "SignPlate.h"
#include "Srgb.h"
#include "Types.h"

#include <png.h>

#include <filesystem>

namespace smokevis
{
namespace
{

const char* const Remedy = "Give a PNG file, a cell of the sign a pixel";

/// libpng's image, freed at the end of its scope.
struct PngImage : png_image
{
  PngImage() : png_image() { this->version = PNG_IMAGE_VERSION; }
  ~PngImage() { png_image_free(this); }
  PngImage(const PngImage&) = delete;
  PngImage& operator=(const PngImage&) = delete;
};

} // namespace

//------------------------------------------------------------------------------
Stencil Stencil::Read(const std::string& fileName)
{
  const std::string where = "pattern file '" + fileName + "'";
  if (fileName.empty())
  {
    throw Error("pattern file", "the pattern is Image but no file is given", Remedy);
  }
  std::error_code code;
  if (!std::filesystem::is_regular_file(fileName, code))
  {
    throw Error(where, "there is no such file", Remedy);
  }
  PngImage image;
  if (png_image_begin_read_from_file(&image, fileName.c_str()) == 0)
  {
    throw Error(
      where, std::string("it is not a PNG image, or damaged (") + image.message + ")", Remedy);
  }
  const auto pixels = static_cast<std::int64_t>(image.width) * image.height;
  if (pixels > MaximumPixels)
  {
    throw Error(where,
      "its " + std::to_string(image.width) + " x " + std::to_string(image.height) +
        " pixels are more than " + std::to_string(MaximumPixels),
      "Scale the image down, a sign needs no more detail than the eye resolves");
  }
  Stencil stencil;
  stencil.Width = static_cast<int>(image.width);
  stencil.Height = static_cast<int>(image.height);
  // Another gamma that the file states is brought to sRGB; of 16 bits, 8 stay. The conversions to
  // linear values and to grey that libpng has round to 8 bits as well.
  image.format = PNG_FORMAT_RGBA;
  image.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;
  std::vector<png_byte> bytes(PNG_IMAGE_SIZE(image));
  // A negative stride puts the bottom row first.
  if (png_image_finish_read(
        &image, nullptr, bytes.data(), -static_cast<png_int_32>(4 * image.width), nullptr) == 0)
  {
    throw Error(where, std::string("it is damaged (") + image.message + ")", Remedy);
  }
  for (std::size_t i = 0; i < bytes.size(); i += 4)
  {
    Spectrum linear{};
    for (int band = 0; band < MaxBands; ++band)
    {
      linear[band] = DecodeSrgb(bytes[i + band] / 255.0);
    }
    // What is transparent counts as black.
    stencil.Grey.push_back(bytes[i + 3] / 255.0 * Luminance(linear, MaxBands));
  }
  return stencil;
}

} // namespace smokevis
