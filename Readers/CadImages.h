// The colours of materials that have an image for a colour.
#pragma once

#include "CadModel.h"

namespace smokevis
{

/// Multiplies the reflectance of each material with an image by the image's mean, made linear.
/// Where an image cannot be read the material has no reflectance, and the model a warning.
void ApplyImages(CadModel& model);

} // namespace smokevis
