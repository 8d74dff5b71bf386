// Checks the lists of indices of a COLLADA file.
#include "ColladaNumbers.h"

#include "Errors.h"
#include "FileBytes.h"

#include <algorithm>
#include <string>
#include <string_view>

namespace smokevis
{

//------------------------------------------------------------------------------------------------
void CheckColladaNumbers(const std::string& fileName)
{
  const std::string text = FileBytes(fileName);
  for (const std::string_view element : {"<p>", "<vcount>", "<v>", "<h>"})
  {
    for (std::size_t at = text.find(element); at != std::string::npos;
         at = text.find(element, at + 1))
    {
      const std::size_t begin = at + element.size();
      const std::size_t end =
        std::min(text.find_first_not_of("-0123456789 \t\r\n", begin), text.size());
      if (text.compare(end, 2, "</") != 0)
      {
        const auto line =
          1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(end), '\n');
        throw Error(fileName + ", line " + std::to_string(line),
          "a list of indices holds something that is not a whole number",
          "Check that the file is complete, or export it again");
      }
    }
  }
}

} // namespace smokevis
