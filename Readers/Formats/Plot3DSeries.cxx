#include "Plot3DSeries.h"

#include "FortranRecords.h"

namespace smokevis
{

//------------------------------------------------------------------------------------------------
Plot3DSeries::Plot3DSeries(const std::vector<std::pair<double, std::string>>& files, int component,
  const std::array<int, 3>& nodes, const std::string& what)
    : nodes_(nodes), component_(component), what_("Plot3D file of " + what)
{
  for (const auto& [time, path] : files)
  {
    std::error_code problem;
    if (std::filesystem::exists(path, problem))
    {
      paths_.push_back(path);
      times_.push_back(time);
    }
    else
    {
      damage_ += (damage_.empty() ? "missing: " : ", ") + path;
    }
  }
  if (paths_.empty())
  {
    throw Error(files.empty() ? "Plot3D" : files.front().second,
      "none of the run's Plot3D files is there",
      "Copy the files that the index names beside the index, or run FDS again");
  }
}

//------------------------------------------------------------------------------------------------
void Plot3DSeries::ReadFrame(std::size_t frame, std::vector<float>& values)
{
  FortranRecords records(paths_[frame], sizeof(nodes_), what_);
  std::array<int, 3> nodes{};
  const std::uint64_t parametersAt = records.Read(0, std::span<int>(nodes));
  if (nodes != nodes_)
  {
    throw Error(records.At(0),
      "the number of nodes of the " + what_ + " is not that of the mesh in the index",
      "The two are of different runs: copy both from the same one");
  }
  std::array<float, 4> parameters{};
  const std::uint64_t valuesAt = records.Read(parametersAt, std::span<float>(parameters));
  const std::uint64_t count = static_cast<std::uint64_t>(nodes_[0]) * nodes_[1] * nodes_[2];
  const std::uint64_t bytes = count * sizeof(float);
  if (!records.Holds(valuesAt, 5 * bytes) || records.Word(valuesAt) != 5 * bytes)
  {
    throw Error(records.At(valuesAt),
      "the " + what_ + " does not hold five quantities on every node",
      "The run may have been stopped while it wrote: read another time");
  }
  values.resize(count);
  records.ReadInside(
    valuesAt + 4 + static_cast<std::uint64_t>(component_) * bytes, std::span<float>(values));
  bytesRead_ += records.BytesRead();
}

} // namespace smokevis
