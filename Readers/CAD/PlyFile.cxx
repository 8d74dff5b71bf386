// Checks a PLY file.
#include "PlyFile.h"

#include "Errors.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <istream>
#include <map>
#include <sstream>
#include <string_view>
#include <vector>

namespace smokevis
{
namespace
{

/// How a type of the format reads its bytes, in this machine's order.
struct Type
{
  int Size;
  double (*Value)(const char* bytes);
};

template <class T> constexpr Type TypeOf()
{
  return {sizeof(T), [](const char* bytes)
    {
      T value;
      std::memcpy(&value, bytes, sizeof(T));
      return static_cast<double>(value);
    }};
}

/// Null for a type that is not known.
const Type* FindType(const std::string& name)
{
  static const std::map<std::string, Type, std::less<>> types = {{"char", TypeOf<std::int8_t>()},
    {"int8", TypeOf<std::int8_t>()}, {"uchar", TypeOf<std::uint8_t>()},
    {"uint8", TypeOf<std::uint8_t>()}, {"short", TypeOf<std::int16_t>()},
    {"int16", TypeOf<std::int16_t>()}, {"ushort", TypeOf<std::uint16_t>()},
    {"uint16", TypeOf<std::uint16_t>()}, {"int", TypeOf<std::int32_t>()},
    {"int32", TypeOf<std::int32_t>()}, {"uint", TypeOf<std::uint32_t>()},
    {"uint32", TypeOf<std::uint32_t>()}, {"float", TypeOf<float>()}, {"float32", TypeOf<float>()},
    {"double", TypeOf<double>()}, {"float64", TypeOf<double>()}};
  const auto found = types.find(name);
  return found == types.end() ? nullptr : &found->second;
}

struct Property
{
  const Type* Value = nullptr;
  /// Of the number of values of a list; null for a single value.
  const Type* Count = nullptr;
};

struct Element
{
  std::string Name;
  std::int64_t Count = 0;
  std::vector<Property> Properties;
};

/// Reads the lines of the header, then walks over what follows.
class Checker
{
public:
  explicit Checker(const std::string& fileName)
      : FileName_(fileName), File_(fileName, std::ios::binary)
  {
  }

  bool Check()
  {
    this->CheckHeader();
    for (const Element& element : this->Elements_)
    {
      for (std::int64_t i = 0; i < element.Count && !element.Properties.empty(); ++i)
      {
        if (!this->Walk(element))
        {
          throw Error(this->FileName_,
            "it is cut short: it ends in element " + element.Name + " number " +
              std::to_string(i + 1) + " of " + std::to_string(element.Count),
            "Copy it again, or export it again");
        }
      }
    }
    return this->Ascii_;
  }

private:
  void CheckHeader()
  {
    std::string text;
    if (!this->NextLine(text) || (text != "ply" && text != "PLY"))
    {
      this->Refuse("the line does not say ply");
    }
    while (this->NextLine(text) && text != "end_header")
    {
      this->CheckLine(text);
    }
    if (text != "end_header")
    {
      this->Refuse("the header has no end");
    }
    double needed = 0.0;
    for (const Element& element : this->Elements_)
    {
      for (const Property& property : element.Properties)
      {
        // In text a value takes a digit and a blank.
        const Type* const least = property.Count ? property.Count : property.Value;
        needed += static_cast<double>(element.Count) * (this->Ascii_ ? 2.0 : least->Size);
      }
    }
    const auto size = static_cast<double>(std::filesystem::file_size(this->FileName_));
    const auto begin = static_cast<double>(this->File_.tellg());
    // The last blank may be missing.
    if (needed - (this->Ascii_ ? 1.0 : 0.0) > size - begin)
    {
      std::ostringstream what;
      what << "its header claims elements of at least " << needed
           << " bytes, of which the file holds " << size - begin;
      this->Refuse(what.str());
    }
  }

  /// Skips an element; false where the file ends before.
  bool Walk(const Element& element)
  {
    for (const Property& property : element.Properties)
    {
      double count = 1.0;
      if (property.Count && !this->NextCount(*property.Count, count))
      {
        return false;
      }
      if (!this->Skip(*property.Value, count))
      {
        return false;
      }
    }
    return true;
  }

  /// Reads the number of values of a list.
  bool NextCount(const Type& type, double& count)
  {
    count = -1.0;
    if (this->Ascii_)
    {
      std::string word;
      if (!(this->File_ >> word))
      {
        return false;
      }
      std::from_chars(word.data(), word.data() + word.size(), count);
    }
    else
    {
      std::array<char, 8> bytes{};
      if (!this->File_.read(bytes.data(), type.Size))
      {
        return false;
      }
      if (this->BigEndian_)
      {
        std::reverse(bytes.begin(), bytes.begin() + type.Size);
      }
      count = type.Value(bytes.data());
    }
    if (!(count >= 0.0) || count != std::floor(count))
    {
      throw Error(this->FileName_, "a list of its elements has no sensible length",
        "Check that the file is complete, or export it again");
    }
    return true;
  }

  /// Skips values; false where the file ends before.
  bool Skip(const Type& type, double count)
  {
    if (this->Ascii_)
    {
      std::string word;
      for (double i = 0.0; i < count; ++i)
      {
        if (!(this->File_ >> word))
        {
          return false;
        }
      }
      return true;
    }
    constexpr double longest = 1e15;
    const auto bytes = static_cast<std::streamsize>(std::min(count * type.Size, longest));
    this->File_.ignore(bytes);
    return this->File_.gcount() == bytes;
  }

  bool NextLine(std::string& text)
  {
    // Longer than any sensible line, so that a file without line breaks is not read whole.
    constexpr std::size_t longest = 4096;
    text.clear();
    for (char c; text.size() < longest && this->File_.get(c) && c != '\n';)
    {
      text += c;
    }
    ++this->Line_;
    if (!text.empty() && text.back() == '\r')
    {
      text.pop_back();
    }
    return !this->File_.fail() && text.size() < longest;
  }

  void CheckLine(const std::string& text)
  {
    std::istringstream line(text);
    std::string word, type, name;
    line >> word;
    if (word == "comment" || word == "obj_info" || word.empty())
    {
      return;
    }
    if (word == "format")
    {
      line >> type;
      this->Ascii_ = type == "ascii";
      this->BigEndian_ = type == "binary_big_endian";
      if (!this->Ascii_ && !this->BigEndian_ && type != "binary_little_endian")
      {
        this->Refuse("the format '" + type + "' is not known");
      }
    }
    else if (word == "element")
    {
      std::int64_t count = -1;
      if (!(line >> name >> count) || count < 0)
      {
        this->Refuse("it is not 'element NAME COUNT'");
      }
      this->Elements_.push_back({name, count, {}});
    }
    else if (word == "property")
    {
      line >> type;
      const bool list = type == "list";
      std::string entries = type;
      if (list)
      {
        line >> type >> entries;
      }
      if (!(line >> name) || !FindType(type) || !FindType(entries))
      {
        this->Refuse("it is not 'property TYPE NAME' or 'property list TYPE TYPE NAME'");
      }
      if (this->Elements_.empty())
      {
        this->Refuse("the property belongs to no element");
      }
      this->Elements_.back().Properties.push_back(
        {FindType(entries), list ? FindType(type) : nullptr});
    }
    else
    {
      this->Refuse("'" + word + "' is no keyword of PLY");
    }
  }

  [[noreturn]] void Refuse(const std::string& what) const
  {
    throw Error(this->FileName_ + ", line " + std::to_string(this->Line_), what,
      "Check that the file is complete, or export it again");
  }

  const std::string& FileName_;
  std::ifstream File_;
  int Line_ = 0;
  bool Ascii_ = true;
  bool BigEndian_ = false;
  std::vector<Element> Elements_;
};

} // namespace

//------------------------------------------------------------------------------------------------
bool CheckPlyFile(const std::string& fileName)
{
  return Checker(fileName).Check();
}

} // namespace smokevis
