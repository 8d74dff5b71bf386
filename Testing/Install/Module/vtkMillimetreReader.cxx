#include "vtkMillimetreReader.h"

#include <vtkObjectFactory.h>

vtkStandardNewMacro(vtkMillimetreReader);

vtkMillimetreReader::vtkMillimetreReader()
{
  this->SetUnitScale(0.001);
}
