// Walks a filter through the time steps of its input. The executive's own loop, which
// CONTINUE_EXECUTING starts, never ends where a step fails upstream (VTK 9.2), so that the steps
// are asked for one by one from RequestData.
#pragma once

#include "KeptOutput.h"

#include <vtkInformationVector.h>

#include <vector>

class vtkInformation;

namespace smokevis
{

/// The time steps of a pipeline connection, none where it has none.
std::vector<double> TimeSteps(vtkInformation* info);

/// For RequestInformation: what comes out belongs to all times.
void DropTime(vtkInformation* output);

/// Every stride-th of the steps within a range (all where its first value is above its last), and
/// the last of them. Throws Error where there is none.
std::vector<double> ChooseSteps(
  const std::vector<double>& steps, const double range[2], int stride);

/// For RequestUpdateExtent: asks for all of the input at a time.
void AskForTime(vtkInformationVector* input, double time);

/// For RequestData: brings all of the input to a time. Throws Error where a filter upstream fails,
/// StoppedUpstream where one was aborted.
void UpdateToTime(vtkInformationVector* input, double time);

} // namespace smokevis
