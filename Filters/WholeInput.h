// Asks upstream for all of an input: a scene is one thing, not pieces.
#pragma once

#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkStreamingDemandDrivenPipeline.h>

namespace smokevis
{

inline void RequestWholeInputs(vtkInformationVector* inputs)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  for (int i = 0; i < inputs->GetNumberOfInformationObjects(); ++i)
  {
    vtkInformation* const info = inputs->GetInformationObject(i);
    info->Set(Pipeline::UPDATE_PIECE_NUMBER(), 0);
    info->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), 1);
    info->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
    if (info->Has(Pipeline::WHOLE_EXTENT()))
    {
      int extent[6];
      info->Get(Pipeline::WHOLE_EXTENT(), extent);
      info->Set(Pipeline::UPDATE_EXTENT(), extent, 6);
    }
  }
}

} // namespace smokevis
