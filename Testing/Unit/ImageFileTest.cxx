// OpenEXR files: what is written comes back, damaged files are errors.
#include "ImageFile.h"
#include "Errors.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>

namespace smokevis
{
namespace
{

/// A folder of its own for each test.
class ImageFileTest : public testing::Test
{
protected:
  void SetUp() override
  {
    this->Folder = std::filesystem::path(testing::TempDir()) /
                   ("ImageFileTest." +
                     std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::create_directories(this->Folder);
  }
  void TearDown() override { std::filesystem::remove_all(this->Folder); }

  static ImageFile Example()
  {
    ImageFile image;
    image.Width = 3;
    image.Height = 2;
    image.Channels["Y"] = {1.0F, 2.0F, 3.0F, 1e-30F, 65536.0F, 1e30F};
    image.Channels["Veil"] = {
      0.0F, -1.0F, 0.25F, 0.5F, std::numeric_limits<float>::infinity(), 0.1F};
    image.Numbers = {{"Contrast", 0.8205}, {"Tiny", 1e-300}};
    image.Texts = {{"Units", "cd/m2"}, {"Empty", ""},
      {"An entry whose name is longer than 31 characters", "text"}};
    return image;
  }

  std::filesystem::path Folder;
};

TEST_F(ImageFileTest, BringsBackWhatWasWritten)
{
  const ImageFile written = Example();
  const std::string name = this->Folder / "image.exr";
  written.Write(name);
  const ImageFile read = ImageFile::Read(name);
  EXPECT_EQ(read.Width, 3);
  EXPECT_EQ(read.Height, 2);
  EXPECT_EQ(read.Channels, written.Channels);
  EXPECT_EQ(read.Numbers, written.Numbers);
  EXPECT_EQ(read.Texts, written.Texts);
  // Nothing but the file is left behind.
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(this->Folder),
              std::filesystem::directory_iterator()),
    1);
}

TEST_F(ImageFileTest, RefusesImagesThatAreNotWhole)
{
  const std::string name = this->Folder / "image.exr";
  ImageFile image = Example();
  image.Channels["Y"].pop_back();
  EXPECT_THROW(image.Write(name), Error);
  EXPECT_THROW(ImageFile().Write(name), Error);
  EXPECT_FALSE(std::filesystem::exists(name));
}

TEST_F(ImageFileTest, KeepsAnOlderFileWhereItCannotWrite)
{
  const std::string name = this->Folder / "image.exr";
  Example().Write(name);
  ImageFile image = Example();
  // A name that OpenEXR keeps for a number of another type.
  image.Texts["pixelAspectRatio"] = "wide";
  EXPECT_THROW(image.Write(name), Error);
  EXPECT_EQ(ImageFile::Read(name).Channels, Example().Channels);
  EXPECT_THROW(Example().Write(this->Folder / "no such folder" / "image.exr"), Error);
}

TEST_F(ImageFileTest, ReportsDamagedFiles)
{
  const std::filesystem::path whole = this->Folder / "image.exr";
  const std::filesystem::path cut = this->Folder / "cut.exr";
  EXPECT_THROW(ImageFile::Read(whole), Error);
  Example().Write(whole);
  const auto size = std::filesystem::file_size(whole);
  for (std::uintmax_t length = 0; length + 1 < size; length += 7)
  {
    std::filesystem::copy_file(whole, cut, std::filesystem::copy_options::overwrite_existing);
    std::filesystem::resize_file(cut, length);
    EXPECT_THROW(ImageFile::Read(cut), Error) << length;
  }
}

} // namespace
} // namespace smokevis
