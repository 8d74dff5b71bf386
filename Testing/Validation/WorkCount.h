// What a report of work says that was done or left out.
#pragma once

#include "LightField.h"

#include <string>
#include <vector>

namespace smokevis
{

/// Sum of the counts of the rows whose "what" and "why" hold these words.
inline double WorkCount(
  const std::vector<WorkItem>& report, const std::string& what, const std::string& why = "")
{
  double sum = 0.0;
  for (const WorkItem& item : report)
  {
    const bool meant =
      item.What.find(what) != std::string::npos && item.Why.find(why) != std::string::npos;
    sum += meant ? item.Count : 0.0;
  }
  return sum;
}

} // namespace smokevis
