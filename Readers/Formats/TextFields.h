// Numbers and words out of the index's data lines, also where fixed-width fields run together.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace smokevis
{

/// The text without blanks, tabs and carriage returns at its two ends.
std::string_view Trim(std::string_view text);

/// The numbers at the start of @p text, up to the first thing that is not a number. Fields without
/// a blank between them are taken apart at signs and, as all fields of one format have the same
/// number of decimals, behind the decimals: "-10.500-2.25012345.000" is three numbers.
std::vector<double> SplitNumbers(std::string_view text);

/// The first @p count integers of @p text. Where blanks do not separate that many, the columns
/// of @p width characters do. Fewer than @p count values come back when the text has no more.
std::vector<int> SplitIntegers(std::string_view text, std::size_t count, std::size_t width);

/// The part of @p text before the first @p mark (all of it when there is none).
std::string_view Before(std::string_view text, char mark);

/// The part of @p text behind the first @p mark (nothing when there is none).
std::string_view After(std::string_view text, char mark);

/// The parts of @p text before and behind the last @p mark; all of it is before where there is
/// none.
std::pair<std::string_view, std::string_view> AroundLast(std::string_view text, char mark);

} // namespace smokevis
