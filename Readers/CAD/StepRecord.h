// Records of exchange files (ISO 10303-21), in which IFC comes too.
#pragma once

#include <functional>
#include <string_view>
#include <vector>

namespace smokevis
{

/// `IFCSIUNIT(*,.LENGTHUNIT.,.MILLI.,.METRE.)`: a name and fields. A list is a record without name.
struct StepRecord
{
  std::string_view Name;
  /// Without the blanks around them, with their own parentheses and quotes.
  std::vector<std::string_view> Fields;
};

/// The text without blanks at its ends.
std::string_view TrimRecord(std::string_view text);

/// Takes a record apart; one without parentheses has neither name nor fields.
StepRecord SplitRecord(std::string_view text);

/// The number in a field, or 0.
double RecordNumber(std::string_view text);

/// Calls visit(number such as "#12", record, whole statement with its semicolon) for each
/// statement; number and record are blank for those that define nothing.
void ForEachRecord(std::string_view text,
  const std::function<void(std::string_view, std::string_view, std::string_view)>& visit);

} // namespace smokevis
