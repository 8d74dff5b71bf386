// 8-bit smoke on the 5 x 4 x 3 nodes of the corpus. The first byte says what it stands for.
#include "FuzzFile.h"

#include "Smoke3DFile.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  using namespace smokevis;
  if (size == 0)
  {
    return 0;
  }
  const std::string sizes = "1\n 0.0 60 9 1.0E-4\n 1.0 60 9 2.0E-4\n";
  fuzz::Write("a.s3d.sz", sizes.data(), sizes.size());
  const std::string path = fuzz::Write("a.s3d", data + 1, size - 1);
  const std::array<int, 3> nodes{5, 4, 3};
  const auto read = [](Smoke3DFile&& file)
  {
    std::vector<float> values;
    for (std::size_t frame = 0; frame < file.FrameTimes().size(); ++frame)
    {
      file.ReadFrame(frame, values);
    }
  };
  return fuzz::Try(
    [&]
    {
      if (data[0] % 2 != 0)
      {
        read(Smoke3DFile(path, nodes, 0.5));
      }
      else
      {
        read(Smoke3DFile(path, nodes, std::array<double, 2>{0.0, 1200.0}));
      }
    });
}
