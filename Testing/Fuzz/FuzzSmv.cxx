// The index, and what is made of it without other files: walls and the choice of files.
#include "FuzzFile.h"

#include "ExtinctionSource.h"
#include "FlameSource.h"
#include "SmvFile.h"
#include "WallBuilder.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  using namespace smokevis;
  const std::string path = fuzz::Write("run.smv", data, size);
  return fuzz::Try(
    [&]
    {
      const SmvFile index(path);
      // Walls are worked out cell by cell; an index of a few lines may have billions of cells.
      double cells = 0.0;
      for (const SmvMesh& mesh : index.Meshes)
      {
        cells += static_cast<double>(mesh.Cells(0)) * mesh.Cells(1) * mesh.Cells(2);
      }
      if (cells < 1e5)
      {
        for (const double time : {index.Times[0], index.Times[1]})
        {
          WallBuilder(index, time, 0.5).Build();
        }
      }
      FlameSource(index, FlameModel::LuminousEfficacy);
      ExtinctionSource(index, {});
    });
}
