// Looks for the ends of CAD files.
#include "FileEnd.h"

#include "Errors.h"
#include "StepRecord.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace smokevis
{
namespace
{

/// A file of which parts are looked at.
class Parts
{
public:
  explicit Parts(const std::string& fileName)
      : Name_(fileName), File_(fileName, std::ios::binary),
        Size_(std::filesystem::file_size(fileName))
  {
  }

  std::uint64_t Size() const { return this->Size_; }

  /// Up to so many bytes from an offset on.
  std::string At(std::uint64_t offset, std::size_t bytes)
  {
    const std::uint64_t there = this->Size_ - std::min(offset, this->Size_);
    std::string text(static_cast<std::size_t>(std::min<std::uint64_t>(bytes, there)), '\0');
    this->File_.clear();
    this->File_.seekg(static_cast<std::streamoff>(offset));
    this->File_.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(this->File_.gcount()));
    return text;
  }

  std::string Tail(std::size_t bytes)
  {
    return this->At(this->Size_ - std::min<std::uint64_t>(bytes, this->Size_), bytes);
  }

  /// A little-endian number; 0 beyond the end.
  template <class T> T Number(std::uint64_t offset)
  {
    static_assert(std::endian::native == std::endian::little);
    const std::string bytes = this->At(offset, sizeof(T));
    T value = 0;
    std::memcpy(&value, bytes.data(), bytes.size() == sizeof(T) ? sizeof(T) : 0);
    return value;
  }

  [[noreturn]] void Refuse(const std::string& what) const
  {
    throw Error(this->Name_, "it is cut short: " + what, "Copy it again, or export it again");
  }

private:
  const std::string& Name_;
  std::ifstream File_;
  std::uint64_t Size_;
};

// Longer than what programs write behind an end mark.
constexpr std::size_t TailBytes = 4096;

std::string_view LastLine(std::string_view text)
{
  const std::string_view trimmed = TrimRecord(text);
  return trimmed.substr(trimmed.find_last_of('\n') + 1);
}

void CheckIges(Parts& file)
{
  // Lines have 80 columns, the section's letter in column 73.
  constexpr std::size_t column = 72;
  const std::string tail = file.Tail(TailBytes);
  const std::string_view last = LastLine(tail);
  if (last.size() <= column || last[column] != 'T')
  {
    file.Refuse("its terminate section (T) is missing");
  }
}

void CheckDxf(Parts& file)
{
  const std::string tail = file.Tail(TailBytes);
  if (TrimRecord(LastLine(tail)) != "EOF")
  {
    file.Refuse("the line EOF at its end is missing");
  }
}

void CheckStl(Parts& file)
{
  constexpr std::uint64_t head = 84;
  constexpr std::uint64_t triangle = 50;
  const std::uint64_t claimed = head + triangle * file.Number<std::uint32_t>(80);
  const std::string tail = file.Tail(TailBytes);
  const bool text = file.At(0, 5) == "solid" && claimed != file.Size();
  if (text ? tail.find("endsolid") == std::string::npos : file.Size() < claimed)
  {
    file.Refuse(text ? "the word endsolid at its end is missing"
                     : "it announces " + std::to_string(claimed) + " bytes and has " +
                         std::to_string(file.Size()));
  }
}

void CheckGltf(Parts& file)
{
  if (file.At(0, 4) == "glTF")
  {
    const auto claimed = file.Number<std::uint32_t>(8);
    if (file.Size() < claimed)
    {
      file.Refuse("it announces " + std::to_string(claimed) + " bytes and has " +
                  std::to_string(file.Size()));
    }
  }
  else if (!TrimRecord(file.Tail(TailBytes)).ends_with('}'))
  {
    file.Refuse("the bracket at its end is missing");
  }
}

void Check3ds(Parts& file)
{
  constexpr std::uint16_t mainChunk = 0x4D4D;
  const auto claimed = file.Number<std::uint32_t>(2);
  if (file.Number<std::uint16_t>(0) == mainChunk && file.Size() < claimed)
  {
    file.Refuse(
      "it announces " + std::to_string(claimed) + " bytes and has " + std::to_string(file.Size()));
  }
}

void CheckBinaryFbx(Parts& file)
{
  // Each node begins with the offset of its end, of 8 bytes from version 7500 on; 0 ends the list.
  const bool large = file.Number<std::uint32_t>(23) >= 7500;
  const std::uint64_t width = large ? 8 : 4;
  std::uint64_t node = 27;
  while (node + width <= file.Size())
  {
    const std::uint64_t end =
      large ? file.Number<std::uint64_t>(node) : file.Number<std::uint32_t>(node);
    if (end == 0)
    {
      return;
    }
    if (end <= node)
    {
      break;
    }
    node = end;
  }
  file.Refuse("its list of nodes has no end");
}

void CheckTextFbx(Parts& file)
{
  // Brackets that open and close, outside of strings and comments, and the section that joins the
  // objects, which comes behind them.
  const std::string text = file.At(0, static_cast<std::size_t>(file.Size()));
  std::int64_t depth = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i)
  {
    quoted = quoted != (text[i] == '"');
    if (!quoted && text[i] == ';')
    {
      i = std::min(text.find('\n', i), text.size() - 1);
    }
    depth += quoted ? 0 : (text[i] == '{') - (text[i] == '}');
  }
  if (depth != 0 || quoted)
  {
    file.Refuse("brackets or quotes stay open");
  }
  if (text.find("Connections:") == std::string::npos)
  {
    file.Refuse("its section Connections is missing");
  }
}

} // namespace

//------------------------------------------------------------------------------------------------
void CheckFileEnd(const std::string& fileName, std::string_view format)
{
  Parts file(fileName);
  const auto needs = [&file](const char* mark)
  {
    if (file.Tail(TailBytes).find(mark) == std::string::npos)
    {
      file.Refuse(std::string(mark) + " at its end is missing");
    }
  };
  if (format == "STEP" || format == "IFC")
  {
    needs("END-ISO-10303-21");
  }
  else if (format == "COLLADA")
  {
    needs("</COLLADA>");
  }
  else if (format == "IGES")
  {
    CheckIges(file);
  }
  else if (format == "DXF")
  {
    CheckDxf(file);
  }
  else if (format == "STL")
  {
    CheckStl(file);
  }
  else if (format == "glTF")
  {
    CheckGltf(file);
  }
  else if (format == "3DS")
  {
    Check3ds(file);
  }
  else if (format == "FBX")
  {
    file.At(0, 18) == "Kaydara FBX Binary" ? CheckBinaryFbx(file) : CheckTextFbx(file);
  }
}

//------------------------------------------------------------------------------------------------
bool EndsInsideLine(const std::string& fileName)
{
  const std::string last = Parts(fileName).Tail(1);
  return last != "\n" && last != "\r";
}

} // namespace smokevis
