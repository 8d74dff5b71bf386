// Which sign a user means: by an entry of a list in the panel, by name or by id.
#pragma once

#include "SignList.h"

#include <cstddef>
#include <string>
#include <vector>

namespace smokevis
{

class View;

inline constexpr std::size_t NoSign = static_cast<std::size_t>(-1);

/// Entry of the list that leaves the choice to an id given elsewhere.
inline constexpr const char* SignById = "(by id)";

/// The entries of the list for a light field: SignById, then "id: name" of each sign.
std::vector<std::string> SignChoices(vtkDataObject* lightField);

/// The id of the sign that an entry or a name stands for; `byId` where that leaves the choice to
/// it. Throws Error, with the signs there are, where the light field has no such sign.
int ChooseSign(const std::string& wanted, int byId, vtkDataObject* lightField);

/// Index of the sign with an id, or NoSign.
std::size_t FindSign(const View& view, int id);

/// The id that most pixels show, or -1 where all are below 0.
int LargestSign(const std::vector<int>& signIds);

} // namespace smokevis
