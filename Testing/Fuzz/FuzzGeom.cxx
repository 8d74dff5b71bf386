// Complex geometry. The first byte says whether it holds solids or cut faces.
#include "FuzzFile.h"

#include "GeomFile.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  using namespace smokevis;
  if (size == 0)
  {
    return 0;
  }
  const std::string path = fuzz::Write("a.ge", data + 1, size - 1);
  return fuzz::Try(
    [&]
    {
      GeomFile file(path, data[0] % 2 != 0);
      for (const double time : {-1.0, 0.5, 9.0})
      {
        const GeomTriangles triangles = file.Read(time);
        for (const auto& triangle : triangles.Triangles)
        {
          for (const int corner : triangle)
          {
            triangles.Points.at(static_cast<std::size_t>(corner));
          }
        }
      }
    });
}
