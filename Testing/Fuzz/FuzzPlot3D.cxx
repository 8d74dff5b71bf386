// Plot3D files on the 3 x 2 x 2 nodes of the corpus.
#include "FuzzFile.h"

#include "Plot3DSeries.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  using namespace smokevis;
  const std::string path = fuzz::Write("a.q", data, size);
  return fuzz::Try(
    [&]
    {
      Plot3DSeries series({{0.0, path}}, 4, {3, 2, 2});
      std::vector<float> values;
      series.ReadFrame(0, values);
    });
}
