// Text files as people save them.
#include "TextLines.h"
#include "ErrorText.h"
#include "Errors.h"

#include <fstream>

#include <gtest/gtest.h>

namespace smokevis
{
namespace
{

std::string WrittenTable(const std::string& bytes)
{
  const std::string name = testing::TempDir() + "/lines.txt";
  std::ofstream(name, std::ios::binary) << bytes;
  return name;
}

std::string TableError(const std::string& bytes)
{
  return test::ErrorText([&] { ReadTableLines("the table", WrittenTable(bytes), "Give one"); });
}

} // namespace

TEST(TextLines, EndsLinesAsAnySystemDoes)
{
  const std::vector<std::string> expected = {"a", "", "b c"};
  EXPECT_EQ(SplitLines("a\n\nb c"), expected);
  EXPECT_EQ(SplitLines("a\r\n\r\nb c\r\n"), expected);
  EXPECT_EQ(SplitLines("a\r\rb c\r"), expected);
  EXPECT_EQ(SplitLines("a\r\n\nb c\r"), expected);
  EXPECT_TRUE(SplitLines("").empty());
}

TEST(TextLines, NumbersTheLinesThatCount)
{
  const std::vector<TextLine> lines =
    ReadTableLines("it", WrittenTable("\xEF\xBB\xBFone\n# two\n \t\n  four \xC3\xB6 \n"), "");
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0].Number, 1);
  EXPECT_EQ(lines[0].Text, "one");
  EXPECT_EQ(lines[1].Number, 4);
  EXPECT_EQ(lines[1].Text, "four \xC3\xB6");
}

TEST(TextLines, RefusesWhatIsNoText)
{
  EXPECT_EQ(TableError("a\nb\n"), "no error");
  EXPECT_EQ(TableError(std::string("\xFF\xFE"
                                   "a\0",
              4)),
    "the table: it is not plain text. Save it as UTF-8, not as UTF-16.");
  EXPECT_NE(TableError(std::string("a\0b", 3)).find("not plain text"), std::string::npos);
  EXPECT_NE(
    TableError("a\n\xFC\n").find("the table, line 2: it holds a letter"), std::string::npos);
  EXPECT_THROW(ReadTableLines("it", "no such file", "Give one"), Error);
  EXPECT_THROW(ReadTableLines("it", testing::TempDir(), "Give one"), Error);
}

} // namespace smokevis
