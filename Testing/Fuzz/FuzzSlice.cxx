// Slice files. The first byte says how values are centred.
#include "FuzzFile.h"

#include "SliceFile.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  using namespace smokevis;
  if (size == 0)
  {
    return 0;
  }
  const std::string path = fuzz::Write("a.sf", data + 1, size - 1);
  return fuzz::Try(
    [&]
    {
      SliceFile slice(path, data[0] % 2 != 0);
      std::vector<float> values;
      slice.ReadFrame(0, values);
      slice.ReadFrame(slice.FrameTimes().size() - 1, values);
    });
}
