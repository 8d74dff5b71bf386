// Boundary files of a mesh of 3 x 2 x 2 cells.
#include "FuzzFile.h"

#include "BoundaryFile.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  using namespace smokevis;
  const std::string path = fuzz::Write("a.bf", data, size);
  SmvMesh mesh;
  mesh.Nodes = {{{0, 1, 2, 3}, {0, 1, 2}, {0, 1, 2}}};
  return fuzz::Try(
    [&]
    {
      BoundaryFile file(path, mesh);
      std::vector<float> values;
      for (std::size_t frame = 0; frame < file.FrameTimes().size(); ++frame)
      {
        file.ReadFrame(frame, values);
      }
    });
}
