// Work that a parallel run asks for several times, as the whole and as pieces in turn, done once.
#pragma once

#include "KeptOutput.h"
#include "Ranks.h"

#include <functional>
#include <optional>

namespace smokevis
{

/// What the outputs that an algorithm keeps were made of, and with which of its properties.
/// @tparam Contents tells inputs apart, such as an Identity
template <class Contents> class KeptOrigin
{
public:
  /// Inside the work given to KeptOutput::Produce. Hands out what is kept where it was made of the
  /// same contents with the same properties in all processes; else does the work.
  /// @param contents of the inputs; nothing where the work is due whatever they are
  void Renew(vtkAlgorithm* algorithm, vtkInformationVector* outputs, const KeptOutput& kept,
    const std::optional<Contents>& contents, const std::function<void()>& work)
  {
    const int ports = outputs->GetNumberOfInformationObjects();
    bool isNew =
      !contents || this->Contents_ != contents || this->Properties_ != algorithm->GetMTime();
    for (int port = 0; port < ports; ++port)
    {
      isNew = isNew || !kept.Has(port);
    }
    if (Ranks().Most(isNew ? 1 : 0) == 0)
    {
      for (int port = 0; port < ports; ++port)
      {
        kept.Show(outputs, port);
      }
      return;
    }
    this->Contents_.reset();
    work();
    this->Contents_ = contents;
    this->Properties_ = algorithm->GetMTime();
  }

private:
  std::optional<Contents> Contents_;
  vtkMTimeType Properties_ = 0;
};

} // namespace smokevis
