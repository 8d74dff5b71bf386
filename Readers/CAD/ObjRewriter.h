// Brings OBJ texts into the form that assimp reads rightly.
#pragma once

#include <string>

namespace smokevis
{

/// Rewrites what assimp misreads in OBJ: it loses vertices whose numbers begin with a point, so
/// that faces take other ones, and refuses comments behind the numbers of a face.
/// @return a blank text where nothing needs rewriting
std::string RewriteObj(const std::string& text);

} // namespace smokevis
