// Lines of text files that people write: tables, curves, photometric files.
#pragma once

#include <string>
#include <vector>

namespace smokevis
{

/// A line of a file.
struct TextLine
{
  /// Counted from 1.
  int Number = 0;
  std::string Text;
};

/// Without blanks at both ends.
std::string Trimmed(const std::string& text);

/// Cuts a text at the ends of its lines, which are those of Unix, Windows or old Macs.
std::vector<std::string> SplitLines(const std::string& text);

/// The lines of a table in a file: trimmed, without those that are empty or begin with #. Throws
/// Error as ReadTextFile does, and with the number of a line that is not UTF-8.
/// @param where names the file in messages
std::vector<TextLine> ReadTableLines(
  const std::string& where, const std::string& fileName, const std::string& remedy);

} // namespace smokevis
