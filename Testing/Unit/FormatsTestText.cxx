// Numbers and words of the index's lines, with and without blanks between them.
#include "Errors.h"
#include "PrintableText.h"
#include "TextFields.h"

#include <gmock/gmock.h>

using testing::ElementsAre;

namespace smokevis
{

TEST(Printable, KeepsWhatCanBeShown)
{
  for (const char* const text :
    {"", "SOOT DENSITY", "T\xC3\xBCr \xE2\x82\xAC \xF0\x9F\x94\xA5", "C:\\runs\tx\ny"})
  {
    EXPECT_EQ(Printable(text), text);
  }
}

TEST(Printable, EscapesEveryOtherByte)
{
  // Control characters of both sets, and one that turns the direction of writing.
  EXPECT_EQ(Printable("\x1B[2Jred\x07\r\x7F"), "\\x1B[2Jred\\x07\\x0D\\x7F");
  EXPECT_EQ(Printable("\xC2\x9B"
                      "2J"),
    "\\xC2\\x9B"
    "2J");
  EXPECT_EQ(Printable("\xE2\x80\xAE"
                      "gnp"),
    "\\xE2\\x80\\xAE"
    "gnp");
  // Latin-1, a character cut short, longer forms than need be, surrogates, and beyond the last.
  EXPECT_EQ(Printable("T\xFCr"), "T\\xFCr");
  EXPECT_EQ(Printable("\xE2\x82"), "\\xE2\\x82");
  EXPECT_EQ(Printable("\xE2"
                      "a"),
    "\\xE2"
    "a");
  EXPECT_EQ(Printable("\xC1\xA1"), "\\xC1\\xA1");
  EXPECT_EQ(Printable("\xE0\x9F\xBF"), "\\xE0\\x9F\\xBF");
  EXPECT_EQ(Printable("\xED\xA0\x80"), "\\xED\\xA0\\x80");
  EXPECT_EQ(Printable("\xF4\x90\x80\x80"), "\\xF4\\x90\\x80\\x80");
  EXPECT_EQ(Printable("\xFF\xFE"), "\\xFF\\xFE");
  EXPECT_EQ(Printable(std::string_view("\0a", 2)), "\\x00a");
}

TEST(Printable, ErrorsQuoteNothingElse)
{
  EXPECT_STREQ(Error("a\x1B", "label 'T\xFCr'", "Do").what(), "a\\x1B: label 'T\\xFCr'. Do.");
}

TEST(SplitNumbers, ReadsFieldsWithBlanks)
{
  EXPECT_THAT(
    SplitNumbers("  12.5  -3 1.0E-03 +4.25 6.D2\r"), ElementsAre(12.5, -3, 1e-3, 4.25, 600));
}

TEST(SplitNumbers, TakesFixedDecimalsApart)
{
  EXPECT_THAT(SplitNumbers("-10.500-2.25012345.000"), ElementsAre(-10.5, -2.25, 12345.0));
  EXPECT_THAT(SplitNumbers("1.00000E+001-2.00000E-001"), ElementsAre(10.0, -0.2));
}

TEST(SplitNumbers, StopsAtWhatIsNoNumber)
{
  EXPECT_THAT(SplitNumbers(" 1 # STRUCTURED & 3"), ElementsAre(1));
  EXPECT_THAT(SplitNumbers(" 1.0 ******** 2.0"), ElementsAre(1.0));
  EXPECT_THAT(SplitNumbers("1e999 2"), ElementsAre());
  EXPECT_THAT(SplitNumbers("nan inf"), ElementsAre());
  EXPECT_THAT(SplitNumbers(""), ElementsAre());
}

TEST(SplitNumbers, TakesUnderflowForZero)
{
  EXPECT_THAT(SplitNumbers("1.0E-999"), ElementsAre(0.0));
}

TEST(SplitIntegers, FallsBackToColumns)
{
  EXPECT_THAT(SplitIntegers("1000020000   34", 3, 5), ElementsAre(10000, 20000, 34));
  EXPECT_THAT(SplitIntegers("  1  2  3  4", 3, 5), ElementsAre(1, 2, 3));
  EXPECT_THAT(SplitIntegers("  1  2", 3, 5), ElementsAre(1, 2));
  EXPECT_THAT(SplitIntegers("  1 2.5 3", 3, 5), ElementsAre(1));
  EXPECT_THAT(SplitIntegers("99999999999 2", 2, 20), ElementsAre());
}

TEST(Words, AreCutAndTrimmed)
{
  EXPECT_EQ(Trim(" \tfire bed \r\n"), "fire bed");
  EXPECT_EQ(Trim("  "), "");
  EXPECT_EQ(Before("a % b % c", '%'), "a ");
  EXPECT_EQ(Before("a", '%'), "a");
  EXPECT_EQ(After("a % b % c", '%'), " b % c");
  EXPECT_EQ(After("a", '%'), "");
}

} // namespace smokevis
