// IES files: symmetries, units, halves, errors by line, and files that break off.
#include "PhotometricFile.h"
#include "ErrorText.h"
#include "IntensityTable.h"

#include <cmath>
#include <numbers>
#include <sstream>

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;
using std::numbers::pi;

const std::string Header = "IESNA:LM-63-2002\r\n"
                           "[TEST] written for this test\r\n"
                           "[MANUFAC] none\r\n"
                           "TILT=NONE\r\n";

/// An intensity that depends on both angles [degrees].
double Candela(double vertical, double horizontal)
{
  return 100.0 + vertical + 0.01 * vertical * horizontal;
}

std::string File(const std::vector<double>& vertical, const std::vector<double>& horizontal,
  const std::string& lamps = "1 1000 1", const std::string& geometry = "1 2 0.6 1.2 0")
{
  std::ostringstream text;
  text << Header << lamps << " " << vertical.size() << " " << horizontal.size() << " " << geometry
       << "\r\n1 1 40\r\n";
  for (const double angle : vertical)
  {
    text << angle << " ";
  }
  text << "\r\n";
  for (const double angle : horizontal)
  {
    text << angle << ",";
  }
  for (const double plane : horizontal)
  {
    text << "\r\n";
    for (const double angle : vertical)
    {
      text << Candela(angle, plane) << " ";
    }
  }
  text << "\r\n";
  return text.str();
}

PhotometricFile Parse(const std::string& text)
{
  return PhotometricFile::Parse(text, "the file");
}

std::string ParseError(const std::string& text)
{
  return test::ErrorText([&] { Parse(text); });
}

TEST(PhotometricFile, OnePlane)
{
  const PhotometricFile file = Parse(File({0, 45, 90}, {0}, "2 -1 3"));
  EXPECT_EQ(file.Horizontal, (std::vector<double>{0}));
  EXPECT_EQ(file.Candela, (std::vector<double>{300, 435, 570}));
  EXPECT_LT(file.RatedFlux, 0.0);
  EXPECT_DOUBLE_EQ(file.Width, 0.6);
  EXPECT_DOUBLE_EQ(file.Length, 1.2);
  // 300 + 3 g degrees: 2 pi times the integral of that times the sine, 300 + 540 / pi.
  EXPECT_NEAR(file.Flux(), 2.0 * pi * (300.0 + 3.0 * 180.0 / pi), 1e-9);
}

// Planes that symmetry leaves out are equal to those that it maps them to.
TEST(PhotometricFile, Symmetries)
{
  const auto check = [](const std::vector<double>& planes, auto&& mapped)
  {
    const PhotometricFile file = Parse(File({0, 30, 90}, planes));
    EXPECT_EQ(file.Horizontal.front(), 0.0);
    EXPECT_EQ(file.Horizontal.back(), 360.0);
    for (std::size_t plane = 0; plane < file.Horizontal.size(); ++plane)
    {
      for (std::size_t i = 0; i < 3; ++i)
      {
        EXPECT_NEAR(file.Candela[3 * plane + i],
          Candela(file.Vertical[i], mapped(file.Horizontal[plane])), 1e-3)
          << "plane " << file.Horizontal[plane];
      }
    }
    return file.Horizontal.size();
  };
  EXPECT_EQ(check({0, 30, 90},
              [](double c) {
                return c <= 90 ? c : c <= 180 ? 180 - c : c <= 270 ? c - 180 : 360 - c;
              }),
    9U);
  EXPECT_EQ(check({0, 45, 180}, [](double c) { return c <= 180 ? c : 360 - c; }), 5U);
  EXPECT_EQ(
    check({90, 120, 180, 270}, [](double c) { return c < 90     ? 180 - c
                                                     : c <= 270 ? c
                                                                : 540 - c; }),
    7U);
  EXPECT_EQ(check({0, 90, 200, 360}, [](double c) { return c; }), 4U);
  // Some leave the last plane, which is the first, out.
  EXPECT_EQ(check({0, 120, 240}, [](double c) { return c < 360 ? c : 0.0; }), 4U);
}

// Both halves together send out what the whole does, and the upper one's azimuth runs backwards.
TEST(PhotometricFile, Halves)
{
  const PhotometricFile file = Parse(File({0, 40, 100, 180}, {0, 90, 180, 270, 360}));
  const PhotometricHalf down = file.Down();
  const PhotometricHalf up = file.Up();
  EXPECT_EQ(down.Polar, (std::vector<double>{0, 40, 90}));
  EXPECT_EQ(up.Polar, (std::vector<double>{0, 80, 90}));
  EXPECT_NEAR(down.Flux + up.Flux, file.Flux(), 1e-9 * file.Flux());
  // Intensity at (100, 90) is that of the upper half at a polar angle of 80 and an azimuth of 270.
  EXPECT_EQ(up.Azimuth[3], 270.0);
  EXPECT_NEAR(up.Candela[3 * 3 + 1], Candela(100, 90), 1e-3);
  const PhotometricHalf none = Parse(File({0, 90}, {0})).Up();
  EXPECT_TRUE(none.Candela.empty());
  EXPECT_EQ(none.Flux, 0.0);
  EXPECT_TRUE(Parse(File({90, 180}, {0})).Down().Candela.empty());
}

TEST(PhotometricFile, UnitsShapesAndFactors)
{
  const PhotometricFile feet = Parse(File({0, 90}, {0}, "3 1500 2", "1 1 2 4 0.5"));
  EXPECT_NEAR(feet.Width, 0.6096, 1e-12);
  EXPECT_NEAR(feet.Length, 1.2192, 1e-12);
  EXPECT_NEAR(feet.Height, 0.1524, 1e-12);
  EXPECT_EQ(feet.RatedFlux, 4500.0);
  EXPECT_EQ(feet.Candela[0], 200.0);
  // A disc of 0.2 m has the area of the square that stands for it.
  for (const char* const disc : {"1 2 -0.2 -0.2 0", "1 2 -0.2 0 0"})
  {
    const PhotometricFile round = Parse(File({0, 90}, {0}, "1 1000 1", disc));
    EXPECT_NEAR(round.Width * round.Length, pi * 0.01, 1e-12);
  }
  std::string tilted = File({0, 90}, {0});
  tilted.replace(tilted.find("TILT=NONE\r\n"), 11, "TILT=INCLUDE\r\n1\r\n2\r\n0 90\r\n0.9 0.5\r\n");
  EXPECT_NEAR(Parse(tilted).Candela[0], 90.0, 1e-12);
  // The oldest files have no header line; numbers may stand on one line.
  EXPECT_EQ(Parse("TILT=NONE\n1 900 1 2 1 1 2 0 0 0 1 1 10 0 90 0 5 6").Candela,
    (std::vector<double>{5, 6}));
}

TEST(PhotometricFile, ErrorsNameTheLine)
{
  const std::string good = File({0, 90}, {0});
  const auto with = [&good](const std::string& from, const std::string& to)
  {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    return ParseError(text);
  };
  const auto holds = [](const std::string& message, const std::string& part)
  { EXPECT_NE(message.find(part), std::string::npos) << message; };
  EXPECT_EQ(ParseError(good), "no error");
  holds(ParseError(""), "no line TILT=");
  holds(with("TILT=NONE", "TILT=lamp.tlt"), "names another file");
  holds(with("1 1000 1 2", "1 1000 x 2"), "line 5: 'x' stands for the candela multiplier");
  holds(with("1 1000 1 2", "0 1000 1 2"), "line 5: the number of lamps is 0");
  holds(with("1 1000 1 2", "1 1000 0 2"), "line 6: the factors");
  holds(with("1 1000 1 2", "1 1000 1 2.5"), "line 5: the number of vertical angles is 2.5");
  holds(with("1 1000 1 2", "1 1000 1 1000000000"), "line 5: the number of vertical angles");
  holds(with("2 1 1 2 0.6", "2 1 2 2 0.6"), "line 5: the photometry is of type B");
  holds(with("2 1 1 2 0.6", "2 1 1 3 0.6"), "line 5: the type of units is 3");
  holds(with("0 90", "0 80"), "line 7: the vertical angles go from 0.000000 to 80");
  holds(with("0 90", "90 0"), "line 7: the vertical angle 0.000000 does not follow 90");
  holds(with("\r\n0,", "\r\n45,"), "line 8: the horizontal angles go from 45");
  // Planes that are missing: 180 of four, or all behind 270 of three.
  for (const std::vector<double>& planes :
    {std::vector<double>{0, 90, 270}, {0, 45, 200}, {0, 270}, {0, 90, 180, 300}, {90, 180, 360}})
  {
    holds(ParseError(File({0, 90}, planes)), "line 8: the horizontal angles go from");
  }
  holds(with("100 190", "100 -190"), "line 9: an intensity is negative");
  holds(with("100 190", "100 190 5"), "line 9: there is more in the file");
  holds(with("100 190", "0 0"), "all intensities are 0");
  holds(with("100 190", "100"), "line 9: the file ends before the intensity");
}

// Line ends of any system are line ends.
TEST(PhotometricFile, LineEnds)
{
  const std::string windows = File({0, 30, 90}, {0, 90});
  for (const std::string end : {"\n", "\r", "\n\r\n"})
  {
    std::string text;
    for (std::size_t i = 0; i < windows.size(); ++i)
    {
      text += windows[i] == '\n' ? end : windows[i] == '\r' ? "" : std::string(1, windows[i]);
    }
    EXPECT_EQ(ParseError(text), "no error");
    EXPECT_EQ(Parse(text).Candela, Parse(windows).Candela);
    text.replace(text.find("1 1000"), 1, "x");
    const std::string line = end == "\n\r\n" ? "line 9" : "line 5";
    EXPECT_NE(ParseError(text).find(line + ": 'x' stands for"), std::string::npos)
      << ParseError(text);
  }
}

// A file that breaks off anywhere is an error, never a crash, unless nothing but its end's blanks
// is missing or the last number is cut to another.
TEST(PhotometricFile, Truncation)
{
  const std::string good = File({0, 30, 60, 90}, {0, 45, 90});
  for (std::size_t length = 0; length + 8 < good.size(); ++length)
  {
    EXPECT_NE(ParseError(good.substr(0, length)), "no error") << length;
  }
  // Bytes that are wrong do not do harm either.
  for (std::size_t place = 0; place < good.size(); ++place)
  {
    for (const char byte : {'\0', '-', '9', ' ', '\n', 'e'})
    {
      std::string text = good;
      text[place] = byte;
      ParseError(text);
    }
  }
}

} // namespace
