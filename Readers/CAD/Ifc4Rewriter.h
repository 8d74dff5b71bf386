// Says the shapes of IFC4 in the words of IFC2x3, the only ones that assimp understands.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace smokevis
{

/// The text of an IFC4 file with tessellated face sets, indexed curves and directly styled items
/// written as IFC2x3 has them; blank for a file of another schema.
/// @param angle largest angle of a straight piece of an arc [degrees]
/// @param unread gets the number of shapes that cannot be said in IFC2x3 and are left out
std::string RewriteIfc4(std::string_view text, double angle, std::size_t& unread);

} // namespace smokevis
