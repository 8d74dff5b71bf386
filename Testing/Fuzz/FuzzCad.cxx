// What is read of CAD files before the libraries get them. The first byte says the format.
#include "FuzzFile.h"

#include "ColladaNumbers.h"
#include "FileEnd.h"
#include "FileHeader.h"
#include "Ifc4Rewriter.h"
#include "PlyFile.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  using namespace smokevis;
  if (size == 0)
  {
    return 0;
  }
  const std::string path = fuzz::Write("a", data + 1, size - 1);
  return fuzz::Try(
    [&]
    {
      switch (data[0] % 5)
      {
      case 0:
        CheckPlyFile(path);
        break;
      case 1:
        CheckColladaNumbers(path);
        ReadColladaHeader(path);
        break;
      case 2:
        ReadDxfHeader(path);
        break;
      case 3:
      {
        ReadIfcHeader(path);
        std::size_t unread = 0;
        RewriteIfc4({reinterpret_cast<const char*>(data) + 1, size - 1}, 15.0, unread);
        break;
      }
      default:
        for (const char* const format : {"STEP", "IGES", "DXF", "STL", "glTF", "3DS", "FBX"})
        {
          fuzz::Try([&] { CheckFileEnd(path, format); });
        }
        EndsInsideLine(path);
      }
    });
}
