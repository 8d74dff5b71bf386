// CAD files that are missing, cut short or damaged, and what is said about them.
#include "CadFile.h"
#include "CadSamples.h"
#include "ErrorText.h"
#include "Errors.h"
#include "FormatsTestRun.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace smokevis::test
{
namespace
{

std::string Message(const std::string& fileName, const CadOptions& options = {})
{
  return test::ErrorText([&] { Read(fileName, options); });
}

TEST(CadErrors, NameTheFileAndTheRemedy)
{
  using testing::AllOf;
  using testing::HasSubstr;
  const Folder folder("cad-errors");
  EXPECT_THAT(Message("/nowhere/a.step"),
    AllOf(HasSubstr("/nowhere/a.step: there is no such file"), HasSubstr("Check the path")));
  EXPECT_THAT(Message(folder.Write("a.dwg", "x")), AllOf(HasSubstr(".dwg"), HasSubstr(".ifc")));
  EXPECT_THAT(Message(folder.Write("plain", "x")), HasSubstr("no extension"));
  EXPECT_THAT(Message(folder.Write("empty.obj", "")), HasSubstr("the file is empty"));
  std::filesystem::create_directory(folder.Path("folder.stl"));
  EXPECT_THAT(Message(folder.Path("folder.stl")), HasSubstr("it is not a file"));
  for (const char* const name : {"a.step", "a.igs", "a.obj", "a.stl", "a.ply", "a.gltf", "a.glb",
         "a.dae", "a.fbx", "a.3ds", "a.dxf", "a.ifc"})
  {
    const std::string file = folder.Write(name, "This is a letter, not a model.\n");
    EXPECT_THAT(Message(file), AllOf(HasSubstr(file), HasSubstr("xport"))) << name;
  }
  EXPECT_THAT(Message(folder.Write("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2 3\n")),
    HasSubstr("xport"));
  EXPECT_THAT(Message(folder.Write("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n")),
    HasSubstr("all of its 1 triangles are degenerate"));
  CadOptions options;
  options.UnitScale = -1.0;
  EXPECT_THAT(Message(Samples + "kiosk.obj", options), HasSubstr("UnitScale"));
  options = {};
  options.AngularTolerance = 0.0;
  EXPECT_THAT(Message(Samples + "kiosk.obj", options), HasSubstr("AngularTolerance"));
  options = {};
  for (const double tolerance : {0.0, 1e-9, -1.0, std::nan(""), HUGE_VAL})
  {
    options.LinearTolerance = tolerance;
    EXPECT_THAT(Message(Samples + "kiosk.obj", options), HasSubstr("LinearTolerance"));
  }
}

TEST(CadErrors, TruncatedFilesAreRefused)
{
  const Folder folder("cad-truncated");
  for (const char* const name :
    {"kiosk.step", "kiosk.igs", "kiosk.stl", "kiosk.ply", "kiosk.gltf", "kiosk.glb", "kiosk.dae",
      "kiosk.fbx", "kiosk.3ds", "kiosk.dxf", "kiosk_ifc4.ifc", "kiosk.ifc"})
  {
    const std::string whole = Bytes(Samples + name);
    // Every byte of the end, where formats differ most in what may be missing.
    std::vector<std::size_t> sizes;
    for (std::size_t size = 1; size < whole.size(); size += size + 250 < whole.size() ? 23 : 1)
    {
      sizes.push_back(size);
    }
    std::size_t refused = 0;
    for (const std::size_t size : sizes)
    {
      const std::string file = folder.Write(name, whole.substr(0, size));
      try
      {
        // Only blanks are missing, or a footer behind the model.
        EXPECT_EQ(Read(file).Triangles.size(), 16U) << name << " cut to " << size << " bytes";
      }
      catch (const Error& error)
      {
        ++refused;
        EXPECT_THAT(error.what(), testing::HasSubstr(file));
      }
    }
    // FBX has a footer of some 180 bytes that says nothing of the model.
    EXPECT_GE(refused + 190, sizes.size()) << name;
    EXPECT_GE(refused, 70U) << name;
  }
}

TEST(CadErrors, TruncatedTextsAreRefused)
{
  using testing::HasSubstr;
  const Folder folder("cad-texts");
  // A triangle each in what the kiosk does not come in.
  const std::string stl = "solid a\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n"
                          "   vertex 1 0 0\n   vertex 0 1 0\n  endloop\n endfacet\nendsolid a\n";
  EXPECT_EQ(Read(folder.Write("a.stl", stl)).Triangles.size(), 1U);
  EXPECT_THAT(Message(folder.Write("a.stl", stl.substr(0, stl.find("endsolid") + 4))),
    HasSubstr("it is cut short: the word endsolid at its end is missing"));

  const std::string head =
    " 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 2\nproperty list uchar int vertex_indices\nend_header\n";
  const std::string ply = "ply\nformat ascii" + head + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 2 1";
  EXPECT_THAT(Read(folder.Write("a.ply", ply + "\n")).Warnings, testing::IsEmpty());
  EXPECT_THAT(Read(folder.Write("a.ply", ply)).Warnings,
    testing::ElementsAre(HasSubstr("the last line of the file has no end")));
  for (std::size_t cut = 1; cut < 8; ++cut)
  {
    EXPECT_THAT(Message(folder.Write("a.ply", ply.substr(0, ply.size() - cut))),
      HasSubstr("it ends in element face number 2 of 2"));
  }
  EXPECT_THAT(Message(folder.Write("a.ply", Replaced(ply, "3 0 1 2", "-3 0 1 2"))),
    HasSubstr("no sensible length"));
  for (const bool big : {false, true})
  {
    std::string binary =
      std::string("ply\nformat binary_") + (big ? "big" : "little") + "_endian" + head;
    const auto put = [&](auto value)
    {
      std::string raw(reinterpret_cast<const char*>(&value), sizeof(value));
      binary += big ? std::string(raw.rbegin(), raw.rend()) : raw;
    };
    for (const float value : {0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F})
    {
      put(value);
    }
    for (int face = 0; face < 2; ++face)
    {
      binary += '\3';
      put(0), put(1), put(2);
    }
    EXPECT_EQ(Read(folder.Write("a.ply", binary)).Triangles.size(), 2U);
    EXPECT_THAT(Message(folder.Write("a.ply", binary.substr(0, binary.size() - 1))),
      HasSubstr("it ends in element face number 2 of 2"));
  }

  const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 4 3";
  EXPECT_THAT(Read(folder.Write("a.obj", obj)).Warnings,
    testing::ElementsAre(HasSubstr("the last line of the file has no end")));
  EXPECT_THAT(Read(folder.Write("a.obj", obj + "\n")).Warnings, testing::IsEmpty());

  const std::string fbx = "; FBX 7.4.0 project file\nFBXHeaderExtension:  {\n\tA: \"}\"\n}\n"
                          "Objects:  {\n}\nConnections:  {\n}\n";
  EXPECT_THAT(Message(folder.Write("a.fbx", fbx)), testing::Not(HasSubstr("cut short")));
  EXPECT_THAT(Message(folder.Write("a.fbx", fbx.substr(0, fbx.size() - 2))),
    HasSubstr("brackets or quotes stay open"));
  EXPECT_THAT(Message(folder.Write("a.fbx", fbx.substr(0, fbx.find("Connections")))),
    HasSubstr("its section Connections is missing"));
}

TEST(CadErrors, DamagedFilesEndInAModelOrAnError)
{
  // Of one damaged byte in three, the libraries follow an invalid address.
  const Folder folder("cad-damaged");
  std::mt19937 random(7);
  for (const char* const name :
    {"kiosk.step", "kiosk.igs", "kiosk.ifc", "kiosk_ifc4.ifc", "kiosk.ply", "kiosk.dae"})
  {
    const std::string whole = Bytes(Samples + name);
    for (int i = 0; i < 20; ++i)
    {
      std::string damaged = whole;
      damaged.at(random() % whole.size()) = static_cast<char>(random());
      damaged.erase(random() % whole.size(), i % 4);
      const std::string file = folder.Write(name, damaged);
      try
      {
        EXPECT_LE(Read(file).Triangles.size(), 16U);
      }
      catch (const Error& error)
      {
        EXPECT_THAT(error.what(), testing::HasSubstr(file));
      }
    }
  }
}

TEST(CadErrors, PlyHeadersAreNotBelieved)
{
  const Folder folder("cad-ply");
  const std::string ply = Bytes(Samples + "kiosk.ply");
  const auto changed = [&](const std::string& from, const std::string& to)
  { return Message(folder.Write("a.ply", Replaced(ply, from, to))); };
  EXPECT_THAT(changed("element face 8", "element face 1000000000"),
    testing::HasSubstr("claims elements of at least 2e+09 bytes"));
  EXPECT_THAT(changed("element vertex 16", "element vertex 9000000000000000000"),
    testing::HasSubstr("claims elements"));
  EXPECT_THAT(changed("element vertex 16", "element vertex -1"), testing::HasSubstr("line 4"));
  EXPECT_THAT(changed("property float nx", "propert# float nx"), testing::HasSubstr("line 8"));
  EXPECT_THAT(changed("property float nx", "property floaty nx"), testing::HasSubstr("line 8"));
  EXPECT_THAT(changed("end_header\n", "end_heade"), testing::HasSubstr("no keyword"));
  EXPECT_THAT(changed("format ascii", "format binary"), testing::HasSubstr("'binary'"));
  EXPECT_THAT(Message(folder.Write("b.ply", ply.substr(0, ply.find("end_header")))),
    testing::HasSubstr("no end"));
}

TEST(CadErrors, StopsWhenAsked)
{
  for (const char* const name : {"kiosk.step", "kiosk.igs", "kiosk.obj", "kiosk.fbx"})
  {
    Progress progress;
    progress.Stop();
    EXPECT_THROW(ReadCadFile(Samples + name, {}, progress), Error) << name;
  }
}

} // namespace
} // namespace smokevis::test
