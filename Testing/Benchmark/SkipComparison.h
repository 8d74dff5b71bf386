// What is saved by leaving something out, and what that changes.
#pragma once

#include "ResultTable.h"

#include <functional>
#include <string>
#include <vector>

namespace smokevis::benchmark
{

/// Values that are held against each other.
using Values = std::vector<double>;

/// Runs a case with and without a skip by turns and writes its row: name, scene, processor time
/// with and without, its ratio, and the largest difference over the value without the skip. Of
/// random results only their sum is to be compared.
/// @param run gives the values of a case, for true with the skip
void Compare(ResultTable& table, const std::string& skip, const std::string& scene,
  const std::function<Values(bool)>& run);

/// Time steps and light fields that filters find unchanged.
void CompareSteps(ResultTable& table);

} // namespace smokevis::benchmark
