#include "Agreement.h"

#include "Errors.h"
#include "Identity.h"
#include "Ranks.h"

#include <vtkDataObject.h>
#include <vtkInformationVector.h>

#include <functional>

namespace smokevis
{

namespace
{

/// What two sums have in common with no other two, in their order.
std::uint64_t Joined(std::uint64_t first, std::uint64_t second)
{
  return first ^ (second + 0x9e3779b97f4a7c15ULL + (first << 6U) + (first >> 2U));
}

} // namespace

//------------------------------------------------------------------------------
void Agreement::Add(const char* name, vtkDataObject* data)
{
  if (this->Ranks_.Count() > 1)
  {
    this->AddSum(name, Fingerprint(data));
  }
}

//------------------------------------------------------------------------------
void Agreement::Add(const char* name, vtkInformationVector* port)
{
  if (this->Ranks_.Count() > 1)
  {
    std::uint64_t sum = port->GetNumberOfInformationObjects();
    for (int i = 0; i < port->GetNumberOfInformationObjects(); ++i)
    {
      sum = Joined(sum, Fingerprint(vtkDataObject::GetData(port, i)));
    }
    this->AddSum(name, sum);
  }
}

//------------------------------------------------------------------------------
void Agreement::Add(const char* name, std::string_view text)
{
  this->AddSum(name, std::hash<std::string_view>()(text));
}

//------------------------------------------------------------------------------
void Agreement::AddSum(const char* name, std::uint64_t sum)
{
  if (this->Ranks_.Count() > 1)
  {
    this->Names_.emplace_back(name);
    this->Sums_.push_back(sum);
  }
}

//------------------------------------------------------------------------------
void Agreement::Check() const
{
  std::string differing;
  const std::vector<bool> alike = this->Ranks_.Alike(this->Sums_);
  for (std::size_t i = 0; i < alike.size(); ++i)
  {
    if (!alike[i])
    {
      differing += (differing.empty() ? "" : ", ") + this->Names_[i];
    }
  }
  if (!differing.empty())
  {
    throw Error("parallel run", "the processes were not given the same: " + differing + " differ",
      "Give all of them the same files, on disks that all machines share, and the same properties");
  }
}

} // namespace smokevis
