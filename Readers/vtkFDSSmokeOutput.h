// Makes the Smoke output of the FDS reader: reads this process's meshes, exchanges them, and says
// in field data what they come from.
#ifndef vtkFDSSmokeOutput_h
#define vtkFDSSmokeOutput_h

#include <string>
#include <vector>

class vtkAlgorithm;
class vtkInformation;

namespace smokevis
{

struct SmokeRequest;

/// Reads the smoke of a run into an output; all processes that read together must call it. Reports
/// progress to @p reader. Returns warnings. Throws what went wrong on any process, and where
/// reading was stopped, which the reader's AbortOutput then tells.
std::vector<std::string> ReadSmokeOutput(
  const SmokeRequest& request, vtkAlgorithm* reader, vtkInformation* output);

} // namespace smokevis

#endif
