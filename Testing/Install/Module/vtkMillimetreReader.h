/**
 * @class   vtkMillimetreReader
 * @brief   reads CAD files in millimetres
 */
#ifndef vtkMillimetreReader_h
#define vtkMillimetreReader_h

#include "ConsumerReadersModule.h"
#include <vtkCADReader.h>

class CONSUMERREADERS_EXPORT vtkMillimetreReader : public vtkCADReader
{
public:
  static vtkMillimetreReader* New();
  vtkTypeMacro(vtkMillimetreReader, vtkCADReader);

protected:
  vtkMillimetreReader();
};

#endif
