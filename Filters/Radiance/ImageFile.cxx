// Reads and writes OpenEXR files. Their rows run from the top down, ours from the bottom up.
#include "ImageFile.h"

#include "Errors.h"

#include <ImfChannelList.h>
#include <ImfDoubleAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>

namespace smokevis
{
namespace
{

/// Most pixels that a file is read with, so that a damaged header does not exhaust the memory.
constexpr std::int64_t MaximumPixels = std::int64_t(1) << 30;

std::vector<float> UpsideDown(const std::vector<float>& rows, int width, int height)
{
  std::vector<float> result(rows.size());
  for (int y = 0; y < height; ++y)
  {
    const auto row = rows.begin() + static_cast<std::ptrdiff_t>(y) * width;
    std::copy(
      row, row + width, result.begin() + static_cast<std::ptrdiff_t>(height - 1 - y) * width);
  }
  return result;
}

void WriteFile(const ImageFile& image, const std::string& fileName)
{
  Imf::Header header(image.Width, image.Height);
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const auto& [name, number] : image.Numbers)
  {
    header.insert(name, Imf::DoubleAttribute(number));
  }
  for (const auto& [name, text] : image.Texts)
  {
    header.insert(name, Imf::StringAttribute(text));
  }
  Imf::FrameBuffer frame;
  std::map<std::string, std::vector<float>> channels;
  for (const auto& [name, values] : image.Channels)
  {
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    std::vector<float>& rows = channels[name];
    rows = UpsideDown(values, image.Width, image.Height);
    frame.insert(name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(rows.data()), sizeof(float),
                         sizeof(float) * image.Width));
  }
  Imf::OutputFile file(fileName.c_str(), header);
  file.setFrameBuffer(frame);
  file.writePixels(image.Height);
}

} // namespace

//------------------------------------------------------------------------------
void ImageFile::Write(const std::string& fileName) const
{
  const std::string where = "image file '" + fileName + "'";
  if (this->Width < 1 || this->Height < 1 || this->Channels.empty())
  {
    throw Error(where, "there is nothing to write", "Give an image with pixels and channels");
  }
  for (const auto& [name, values] : this->Channels)
  {
    if (values.size() != static_cast<std::size_t>(this->Width) * this->Height)
    {
      throw Error(where, "channel " + name + " does not have a value a pixel");
    }
  }
  // A file that cannot be finished leaves an older one of its name as it was.
  const std::string part = fileName + ".part";
  try
  {
    WriteFile(*this, part);
    std::filesystem::rename(part, fileName);
  }
  catch (const std::exception& error)
  {
    std::error_code ignored;
    std::filesystem::remove(part, ignored);
    throw Error(where, std::string("it cannot be written (") + error.what() + ")",
      "Check the folder, its permissions and the space that is left");
  }
}

//------------------------------------------------------------------------------
ImageFile ImageFile::Read(const std::string& fileName)
{
  const std::string where = "image file '" + fileName + "'";
  try
  {
    Imf::InputFile file(fileName.c_str());
    const Imf::Header& header = file.header();
    const Imath::Box2i window = header.dataWindow();
    const std::int64_t width = static_cast<std::int64_t>(window.max.x) - window.min.x + 1;
    const std::int64_t height = static_cast<std::int64_t>(window.max.y) - window.min.y + 1;
    if (width < 1 || height < 1 || width > MaximumPixels / height)
    {
      throw Error(where, "its size is not sensible", "Give an undamaged OpenEXR file");
    }
    ImageFile image;
    image.Width = static_cast<int>(width);
    image.Height = static_cast<int>(height);
    Imf::FrameBuffer frame;
    for (auto i = header.channels().begin(); i != header.channels().end(); ++i)
    {
      if (i.channel().xSampling != 1 || i.channel().ySampling != 1)
      {
        throw Error(where, std::string("channel ") + i.name() + " is subsampled",
          "Save the image with full channels");
      }
      std::vector<float>& rows = image.Channels[i.name()];
      rows.resize(width * height);
      frame.insert(i.name(),
        Imf::Slice::Make(Imf::FLOAT, rows.data(), window, sizeof(float), sizeof(float) * width));
    }
    file.setFrameBuffer(frame);
    file.readPixels(window.min.y, window.max.y);
    for (auto& [name, rows] : image.Channels)
    {
      rows = UpsideDown(rows, image.Width, image.Height);
    }
    for (auto i = header.begin(); i != header.end(); ++i)
    {
      if (const auto* number = dynamic_cast<const Imf::DoubleAttribute*>(&i.attribute()))
      {
        image.Numbers[i.name()] = number->value();
      }
      else if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&i.attribute()))
      {
        image.Texts[i.name()] = text->value();
      }
    }
    return image;
  }
  catch (const Error&)
  {
    throw;
  }
  catch (const std::exception& error)
  {
    throw Error(where, std::string("it cannot be read (") + error.what() + ")",
      "Give an undamaged OpenEXR file");
  }
}

} // namespace smokevis
