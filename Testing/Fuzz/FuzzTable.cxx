// Material tables. The first byte says whether the rest is CSV or JSON.
#include "FuzzFile.h"

#include "MaterialTable.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  using namespace smokevis;
  if (size == 0)
  {
    return 0;
  }
  const std::string path = fuzz::Write(data[0] % 2 != 0 ? "a.json" : "a.csv", data + 1, size - 1);
  return fuzz::Try(
    [&]
    {
      const MaterialTable table(path);
      CadModel model;
      model.Materials.emplace_back().Name = "Glass";
      model.Objects.push_back({"ExitSign-03", {"House"}});
      table.Find(model.Materials[0], model.Objects[0]);
      table.Unmatched(model);
    });
}
