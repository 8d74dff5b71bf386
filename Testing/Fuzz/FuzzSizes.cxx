// The text file with the greatest densities of 8-bit smoke (.sz).
#include "FuzzFile.h"

#include "Smoke3DFile.h"

#include <cstring>

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  using namespace smokevis;
  // Two frames of 2 x 2 x 2 nodes, version 1.
  std::string smoke;
  const auto put = [&smoke](auto value)
  { smoke.append(reinterpret_cast<const char*>(&value), sizeof(value)); };
  for (const int word : {32, 1, 1, 0, 1, 0, 1, 0, 1, 32})
  {
    put(word);
  }
  for (const float time : {0.0F, 1.0F})
  {
    put(4), put(time), put(4);
    put(8), put(8), put(3), put(8);
    put(3), smoke.append("\xff\x64\x08", 3), put(3);
  }
  const std::string path = fuzz::Write("b.s3d", smoke.data(), smoke.size());
  fuzz::Write("b.s3d.sz", data, size);
  return fuzz::Try(
    [&]
    {
      Smoke3DFile file(path, {2, 2, 2}, 0.5);
      std::vector<float> values;
      file.ReadFrame(0, values);
    });
}
