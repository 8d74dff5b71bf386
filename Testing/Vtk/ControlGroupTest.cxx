// Memory limits of containers and batch systems, in folders as the kernel shows them.
#include "ControlGroup.h"

#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>

namespace
{

namespace fs = std::filesystem;

class ControlGroupTest : public testing::Test
{
protected:
  ControlGroupTest() : Root(fs::path(testing::TempDir()) / "ControlGroupTest")
  {
    fs::remove_all(this->Root);
  }
  ~ControlGroupTest() override { fs::remove_all(this->Root); }

  void Write(const std::string& path, const std::string& content) const
  {
    const fs::path file = this->Root / path;
    fs::create_directories(file.parent_path());
    std::ofstream(file) << content << "\n";
  }
  double Free() const
  {
    return smokevis::FreeMemoryOfGroup((this->Root / "self").string(), this->Root.string());
  }

  fs::path Root;
};

TEST_F(ControlGroupTest, WithoutGroupsNothingIsLimited)
{
  EXPECT_TRUE(std::isinf(this->Free()));
  this->Write("self", "0::/");
  EXPECT_TRUE(std::isinf(this->Free()));
  for (const char* const line : {"nonsense", "0::nowhere", "0::", "::"})
  {
    this->Write("self", line);
    EXPECT_TRUE(std::isinf(this->Free())) << line;
  }
  this->Write("self", "");
  EXPECT_TRUE(std::isinf(this->Free()));
}

TEST_F(ControlGroupTest, SecondVersionCountsTheTightestOfItsAncestors)
{
  this->Write("self", "0::/job/step");
  this->Write("job/step/memory.max", "max");
  this->Write("job/step/memory.current", "600");
  EXPECT_TRUE(std::isinf(this->Free()));
  this->Write("job/memory.max", "1000");
  this->Write("job/memory.current", "700");
  EXPECT_EQ(this->Free(), 300.0);
  this->Write("job/memory.stat", "anon 550\nfile 150\ninactive_file 100\nactive_file 50");
  EXPECT_EQ(this->Free(), 450.0);
  this->Write("job/step/memory.max", "640");
  EXPECT_EQ(this->Free(), 40.0);
}

TEST_F(ControlGroupTest, FirstVersionIsReadWhereMemoryIsOneOfItsControllers)
{
  this->Write("self", "5:cpu,memory:/pod\n1:cpuset:/\n0::/");
  this->Write("memory/pod/memory.limit_in_bytes", "4096");
  this->Write("memory/pod/memory.usage_in_bytes", "4000");
  this->Write(
    "memory/pod/memory.stat", "inactive_file 1\ntotal_inactive_file 20\ntotal_active_file 4");
  EXPECT_EQ(this->Free(), 120.0);
}

TEST_F(ControlGroupTest, AContainerShowsItsGroupAsTheRoot)
{
  this->Write("self", "0::/not/shown/here");
  this->Write("memory.max", "1000");
  this->Write("memory.current", "1500");
  // Just lowered below what is in use.
  EXPECT_EQ(this->Free(), -500.0);
}

} // namespace
