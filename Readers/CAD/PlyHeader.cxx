// Checks the header of a PLY file.
#include "PlyHeader.h"

#include "Errors.h"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <istream>
#include <map>
#include <sstream>
#include <string_view>

namespace smokevis
{
namespace
{

/// Bytes of a value, 0 for a type that is not known.
int SizeOfType(const std::string& type)
{
  static const std::map<std::string, int, std::less<>> sizes = {{"char", 1}, {"uchar", 1},
    {"int8", 1}, {"uint8", 1}, {"short", 2}, {"ushort", 2}, {"int16", 2}, {"uint16", 2}, {"int", 4},
    {"uint", 4}, {"int32", 4}, {"uint32", 4}, {"float", 4}, {"float32", 4}, {"double", 8},
    {"float64", 8}};
  const auto found = sizes.find(type);
  return found == sizes.end() ? 0 : found->second;
}

/// Reads the lines of a header.
class Header
{
public:
  explicit Header(const std::string& fileName)
      : FileName_(fileName), File_(fileName, std::ios::binary)
  {
  }

  void Check()
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
    this->Close();
    const auto size = static_cast<double>(std::filesystem::file_size(this->FileName_));
    const auto begin = static_cast<double>(this->File_.tellg());
    if (this->Needed_ > size - begin)
    {
      std::ostringstream what;
      what << "its header claims elements of at least " << this->Needed_
           << " bytes, of which the file holds " << size - begin;
      this->Refuse(what.str());
    }
  }

private:
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
      if (!this->Ascii_ && type != "binary_little_endian" && type != "binary_big_endian")
      {
        this->Refuse("the format '" + type + "' is not known");
      }
    }
    else if (word == "element")
    {
      this->Close();
      std::int64_t count = -1;
      if (!(line >> name >> count) || count < 0)
      {
        this->Refuse("it is not 'element NAME COUNT'");
      }
      this->Count_ = static_cast<double>(count);
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
      if (!(line >> name) || SizeOfType(type) == 0 || SizeOfType(entries) == 0)
      {
        this->Refuse("it is not 'property TYPE NAME' or 'property list TYPE TYPE NAME'");
      }
      // In text a value takes a digit and a blank.
      this->Bytes_ += this->Ascii_ ? 2.0 : SizeOfType(type);
    }
    else
    {
      this->Refuse("'" + word + "' is no keyword of PLY");
    }
  }

  /// Ends the element that is being described.
  void Close()
  {
    this->Needed_ += this->Count_ * this->Bytes_;
    this->Count_ = this->Bytes_ = 0.0;
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
  double Count_ = 0.0;
  double Bytes_ = 0.0;
  double Needed_ = 0.0;
};

} // namespace

//------------------------------------------------------------------------------------------------
void CheckPlyHeader(const std::string& fileName)
{
  Header(fileName).Check();
}

} // namespace smokevis
