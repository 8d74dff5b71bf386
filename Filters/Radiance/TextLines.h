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

/// The text of a file without the mark that some editors begin UTF-8 with. Throws Error for a file
/// that cannot be read and for one that is no plain text (UTF-16, or with bytes of 0).
/// @param name   what the file is, for messages, such as "sign table 'a.csv'"
/// @param remedy what to do where there is no such file
std::string ReadText(
  const std::string& fileName, const std::string& name, const std::string& remedy);

/// Cuts a text at the ends of its lines, which are those of Unix, Windows or old Macs.
std::vector<std::string> SplitLines(const std::string& text);

/// The lines of a table: trimmed, without those that are empty or begin with #. Throws Error as
/// ReadText does, and with the number of a line that is not UTF-8.
std::vector<TextLine> ReadTableLines(
  const std::string& fileName, const std::string& name, const std::string& remedy);

} // namespace smokevis
