#include "Agreement.h"

#include "Errors.h"
#include "Identity.h"
#include "Ranks.h"

#include <functional>

namespace smokevis
{

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
    this->AddSum(name, Fingerprint(port));
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
