// CAD files of every format: size, fronts, names, colours, units and axes.
#include "CadFile.h"
#include "CadSamples.h"
#include "Errors.h"
#include "FormatsTestRun.h"
#include "SrgbColor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <sys/stat.h>

namespace smokevis::test
{
namespace
{

/// A file of the kiosk and what is special about its format.
struct Sample
{
  const char* File;
  const char* Format;
  double UnitScale;
  CadSource UnitSource;
  UpAxis Up;
  CadSource UpSource;
  bool Names;
  bool Colors;
  bool LinearColors;
};

void PrintTo(const Sample& sample, std::ostream* stream)
{
  *stream << sample.File;
}

class CadSample : public testing::TestWithParam<Sample>
{
};

TEST_P(CadSample, IsReadInMetresWithZUp)
{
  const Sample& sample = GetParam();
  const CadModel model = Read(Samples + sample.File);
  EXPECT_EQ(model.Format, sample.Format);
  EXPECT_DOUBLE_EQ(model.UnitScale, sample.UnitScale);
  EXPECT_EQ(model.UnitSource, sample.UnitSource);
  EXPECT_EQ(model.Up, sample.Up);
  EXPECT_EQ(model.UpSource, sample.UpSource);
  EXPECT_EQ(model.DegenerateTriangles, 0U);
  EXPECT_THAT(model.Warnings, testing::IsEmpty());
  EXPECT_EQ(model.Triangles.size(), 16U);

  // Coordinates of a few metres have 24 bits, or six decimals, in the files.
  constexpr double rounding = 2e-6;
  const Measure all = MeasureObject(model);
  EXPECT_NEAR(all.Area, 22.0 + 0.045 + 1.0, 20 * rounding);
  EXPECT_THAT(all.Low, testing::Pointwise(testing::DoubleNear(rounding), {1.0, 1.99, 0.0}));
  EXPECT_THAT(all.High, testing::Pointwise(testing::DoubleNear(rounding), {3.0, 4.0, 3.0}));
  if (sample.Names)
  {
    const Measure block = MeasureObject(model, "Kiosk");
    EXPECT_NEAR(block.Area, 22.0, 20 * rounding);
    // Positive: fronts look outwards.
    EXPECT_NEAR(block.Volume, 6.0, 20 * rounding);
    const Measure sign = MeasureObject(model, "ExitSign-03");
    EXPECT_NEAR(sign.Area, 0.3 * 0.15, rounding);
    // A third of the area times the distance from the origin along the normal, which is -y.
    EXPECT_NEAR(sign.Volume, -1.99 * 0.045 / 3.0, rounding);
  }
}

TEST_P(CadSample, HasTheColorsOfItsMaterials)
{
  const Sample& sample = GetParam();
  const CadModel model = Read(Samples + sample.File);
  int plaster = 0, glass = 0;
  for (const CadTriangle& triangle : model.Triangles)
  {
    const CadMaterial& material = model.Materials.at(triangle.Material);
    ASSERT_EQ(material.Reflectance.has_value(), sample.Colors);
    if (!sample.Colors)
    {
      continue;
    }
    const std::string& object = model.Objects.at(triangle.Object).Name;
    if (object == "Kiosk")
    {
      ++plaster;
      // The numbers in the file.
      const double srgb[3] = {0.8, 0.7, 0.6};
      for (int i = 0; i < 3; ++i)
      {
        const double expected = sample.LinearColors ? srgb[i] : LinearFromSrgb(srgb[i]);
        // 3DS keeps eight bits.
        EXPECT_NEAR((*material.Reflectance)[i], expected, 0.004);
      }
      EXPECT_EQ(material.Opacity, 1.0);
    }
    else if (object == "Glazing-1")
    {
      ++glass;
      EXPECT_NEAR(material.Opacity, 0.2, 0.005);
    }
  }
  if (sample.Colors && sample.Names)
  {
    EXPECT_EQ(plaster, 12);
    EXPECT_EQ(glass, 2);
  }
}

constexpr CadSource Stated = CadSource::File;
constexpr CadSource Default = CadSource::Format;

INSTANTIATE_TEST_SUITE_P(Formats, CadSample,
  testing::Values(
    Sample{"kiosk.step", "STEP", 0.001, Stated, UpAxis::Z, Default, true, true, false},
    Sample{"kiosk.igs", "IGES", 0.001, Stated, UpAxis::Z, Default, false, true, false},
    Sample{"kiosk.obj", "OBJ", 1.0, Default, UpAxis::Y, Default, true, true, false},
    Sample{"kiosk.stl", "STL", 1.0, Default, UpAxis::Z, Default, false, false, false},
    Sample{"kiosk.ply", "PLY", 1.0, Default, UpAxis::Z, Default, false, false, false},
    Sample{"kiosk.gltf", "glTF", 1.0, Default, UpAxis::Y, Default, true, true, true},
    Sample{"kiosk.glb", "glTF", 1.0, Default, UpAxis::Y, Default, true, true, true},
    Sample{"kiosk.dae", "COLLADA", 1.0, Stated, UpAxis::Z, Stated, true, true, false},
    Sample{"kiosk.fbx", "FBX", 0.01, Stated, UpAxis::Y, Stated, true, true, false},
    Sample{"kiosk.3ds", "3DS", 1.0, Default, UpAxis::Z, Default, false, true, false},
    Sample{"kiosk.dxf", "DXF", 0.001, Stated, UpAxis::Z, Default, true, false, false},
    Sample{"kiosk_ifc4.ifc", "IFC", 0.001, Stated, UpAxis::Z, Default, true, true, false},
    Sample{"kiosk.ifc", "IFC", 0.001, Stated, UpAxis::Z, Default, true, true, false}),
  [](const testing::TestParamInfo<Sample>& sample)
  { return Replaced(sample.param.File, ".", "_"); });

//------------------------------------------------------------------------------------------------
/// Share by which a regular polygon with edges of the half angle `a` is smaller than its circle.
double AreaDeficit(double a)
{
  return 1.0 - std::sin(2.0 * a) / (2.0 * a);
}

TEST(CadBRep, CylinderMeetsTheTolerance)
{
  const Folder folder("cad-cylinder");
  const std::string file = folder.Path("cylinder.step");
  constexpr double radius = 0.5, height = 2.0;
  WriteStepCylinder(file, "MM", radius, height);
  const double volume = std::numbers::pi * radius * radius * height;
  for (const double tolerance : {0.02, 0.005, 0.0005, 0.00005})
  {
    CadOptions options;
    options.LinearTolerance = tolerance;
    options.AngularTolerance = 90.0;
    const CadModel model = Read(file, options);
    const Measure measure = MeasureObject(model, "Column");
    // The sagitta of an edge is r (1 - cos a) of its half angle a.
    const double halfAngle = std::acos(1.0 - tolerance / radius);
    EXPECT_LE(measure.Volume, volume);
    EXPECT_GE(measure.Volume, volume * (1.0 - AreaDeficit(halfAngle)));
    // The mantle shrinks with the length of the edges, the ends with the area.
    const double mantle = 2.0 * std::numbers::pi * radius * height;
    const double ends = 2.0 * std::numbers::pi * radius * radius;
    EXPECT_LE(measure.Area, mantle + ends);
    EXPECT_GE(measure.Area,
      mantle * std::sin(halfAngle) / halfAngle + ends * (1.0 - AreaDeficit(halfAngle)));
  }
}

TEST(CadBRep, CylinderMeetsTheAngle)
{
  const Folder folder("cad-angle");
  const std::string file = folder.Path("cylinder.stp");
  WriteStepCylinder(file, "MM", 0.5, 2.0);
  CadOptions options;
  options.LinearTolerance = 0.1;
  options.AngularTolerance = 5.0;
  const double least = std::numbers::pi * 0.5 * (1.0 - AreaDeficit(2.5 * std::numbers::pi / 180));
  EXPECT_GE(MeasureObject(Read(file, options)).Volume, least);
}

TEST(CadBRep, UnitsOfTheFileCount)
{
  const Folder folder("cad-units");
  const struct
  {
    const char* Name;
    double Scale;
  } units[] = {{"MM", 0.001}, {"CM", 0.01}, {"M", 1.0}, {"INCH", 0.0254}};
  for (const auto& unit : units)
  {
    const std::string file = folder.Path(std::string(unit.Name) + ".step");
    WriteStepCylinder(file, unit.Name, 0.5, 2.0);
    const CadModel model = Read(file);
    EXPECT_DOUBLE_EQ(model.UnitScale, unit.Scale);
    EXPECT_EQ(model.UnitSource, CadSource::File);
    EXPECT_NEAR(MeasureObject(model).High[2], 2.0, 1e-9) << unit.Name;
    // Overruled: a unit of the file is 1 m.
    CadOptions options;
    options.UnitScale = 1.0;
    options.LinearTolerance = 0.005 / unit.Scale;
    const CadModel scaled = Read(file, options);
    EXPECT_EQ(scaled.UnitSource, CadSource::User);
    EXPECT_NEAR(MeasureObject(scaled).High[2], 2.0 / unit.Scale, 1e-9 / unit.Scale) << unit.Name;
    EXPECT_EQ(scaled.Triangles.size(), model.Triangles.size());
  }
}

TEST(CadBRep, PartsKeepNamesAndAssemblies)
{
  const CadModel model = Read(Samples + "kiosk.step");
  std::vector<std::string> names;
  for (const CadObject& object : model.Objects)
  {
    names.push_back(object.Name);
    EXPECT_THAT(object.Groups, testing::ElementsAre("Building"));
  }
  EXPECT_THAT(names, testing::ElementsAre("Kiosk", "ExitSign-03", "Glazing-1"));
  EXPECT_EQ(model.Materials.at(0).Name, "#CCB299");
}

//------------------------------------------------------------------------------------------------
TEST(CadMesh, CubeOfAnyUnitAndAxis)
{
  const Folder folder("cad-cube");
  // Two millimetres by one by three, y up as is usual in OBJ.
  std::string text = "o Cube\n";
  for (int i = 0; i < 8; ++i)
  {
    text += "v " + std::to_string(i & 1 ? 2 : 0) + " " + std::to_string(i & 2 ? 3 : 0) + " " +
            std::to_string(i & 4 ? -1 : 0) + "\n";
  }
  text += "f 1 2 4 3\nf 5 7 8 6\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4\n";
  const std::string file = folder.Write("cube.OBJ", text);
  CadOptions options;
  options.UnitScale = 0.001;
  const CadModel model = Read(file, options);
  const Measure measure = MeasureObject(model, "Cube");
  EXPECT_NEAR(measure.Area, 2.0 * (2.0 + 3.0 + 6.0) * 1e-6, 1e-18);
  EXPECT_NEAR(measure.Volume, 6.0 * 1e-9, 1e-21);
  EXPECT_THAT(measure.High, testing::Pointwise(testing::DoubleNear(1e-15), {0.002, 0.001, 0.003}));
  options.Up = UpAxis::Z;
  EXPECT_THAT(MeasureObject(Read(file, options)).High,
    testing::Pointwise(testing::DoubleNear(1e-15), {0.002, 0.003, 0.0}));
  options.Up = UpAxis::X;
  EXPECT_THAT(MeasureObject(Read(file, options)).High,
    testing::Pointwise(testing::DoubleNear(1e-15), {0.003, 0.0, 0.002}));
  EXPECT_NEAR(MeasureObject(Read(file, options)).Volume, 6.0 * 1e-9, 1e-21);
}

TEST(CadMesh, StatedUnitsAndAxes)
{
  const Folder folder("cad-stated");
  const std::string dae = Bytes(Samples + "kiosk.dae");
  const CadModel inches = Read(folder.Write(
    "inch.dae", Replaced(dae, "<unit name=\"meter\" meter=\"1\"/>", "<unit meter=\"0.0254\"/>")));
  EXPECT_DOUBLE_EQ(inches.UnitScale, 0.0254);
  EXPECT_NEAR(MeasureObject(inches).High[2], 3.0 * 0.0254, 1e-7);
  const CadModel y = Read(folder.Write("y.dae", Replaced(dae, "<up_axis>Z_UP", "<up_axis>Y_UP")));
  EXPECT_NEAR(MeasureObject(y).High[2], 4.0, 1e-6);

  const std::string ifc = Bytes(Samples + "kiosk.ifc");
  const CadModel feet =
    Read(folder.Write("foot.ifc", Replaced(ifc, "#11=IFCSIUNIT(*,.LENGTHUNIT.,.MILLI.,.METRE.);",
                                    "#11=IFCCONVERSIONBASEDUNIT(#90,.LENGTHUNIT.,'FOOT',#91);\n"
                                    "#90=IFCDIMENSIONALEXPONENTS(1,0,0,0,0,0,0);\n"
                                    "#91=IFCMEASUREWITHUNIT(IFCLENGTHMEASURE(0.3048),#92);\n"
                                    "#92=IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.);")));
  EXPECT_DOUBLE_EQ(feet.UnitScale, 0.3048);
  EXPECT_NEAR(MeasureObject(feet).High[2], 3000.0 * 0.3048, 1e-3);

  const std::string dxf = Bytes(Samples + "kiosk.dxf");
  const std::size_t code = dxf.find("$INSUNITS");
  ASSERT_NE(code, std::string::npos);
  std::string metres = dxf;
  metres.replace(metres.find('4', metres.find("70", code)), 1, "6");
  EXPECT_NEAR(MeasureObject(Read(folder.Write("m.dxf", metres))).High[2], 3000.0, 1e-3);
}

TEST(CadMesh, ArcsAndHolesOfIfc4)
{
  const Folder folder("cad-ifc4");
  const std::string ifc = Bytes(Samples + "kiosk_ifc4.ifc");
  // Two arcs make a disc of 0.5 m, extruded by 3 m.
  const std::string disc = Replaced(Replaced(ifc, "((0.,0.),(1000.,0.),(1000.,2000.),(0.,2000.))",
                                      "((-500.,0.),(0.,500.),(500.,0.),(0.,-500.))"),
    "(IFCLINEINDEX((1,2,3)),IFCLINEINDEX((3,4)),IFCLINEINDEX((4,1)))",
    "(IFCARCINDEX((1,2,3)),IFCARCINDEX((3,4,1)))");
  for (const double angle : {15.0, 3.0})
  {
    CadOptions options;
    options.AngularTolerance = angle;
    const double volume = std::numbers::pi * 0.25 * 3.0;
    const double inscribed = volume * (1.0 - AreaDeficit(0.5 * angle * std::numbers::pi / 180));
    EXPECT_NEAR(MeasureObject(Read(folder.Write("disc.ifc", disc), options), "Kiosk").Volume,
      inscribed, 1e-5 * volume);
  }
  // A pane of 1 m2 with a hole of a quarter.
  const std::string hole = Replaced(Replaced(ifc, "(3000.,2000.,2000.)))",
                                      "(3000.,2000.,2000.),(3000.,2250.,1250.),(3000.,2250.,1750.),"
                                      "(3000.,2750.,1750.),(3000.,2750.,"
                                      "1250.)))"),
    "IFCINDEXEDPOLYGONALFACE((1,2,3,4))",
    "IFCINDEXEDPOLYGONALFACEWITHVOIDS((1,2,3,4),((5,6,7,8)))");
  EXPECT_NEAR(MeasureObject(Read(folder.Write("hole.ifc", hole)), "Glazing-1").Area, 0.75, 1e-6);
}

TEST(CadMesh, MirroredPartsKeepTheirFronts)
{
  const Folder folder("cad-mirror");
  std::string dae = Bytes(Samples + "kiosk.dae");
  const std::string matrix = "<matrix sid=\"transform\">";
  const std::size_t at = dae.find(matrix, dae.find("<node id=\"Kiosk\""));
  ASSERT_NE(at, std::string::npos);
  dae.insert(at + matrix.size(), "-");
  const CadModel model = Read(folder.Write("mirror.dae", dae));
  const Measure measure = MeasureObject(model, "Kiosk");
  EXPECT_NEAR(measure.High[0], -1.0, 1e-6);
  EXPECT_NEAR(measure.Volume, 6.0, 1e-5);
}

TEST(CadMesh, ColorsOfCorners)
{
  const Folder folder("cad-corners");
  const CadModel model = Read(folder.Write("corners.ply",
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
    "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0 255 0 128\n1 0 0 255 0 128\n0 1 0 255 255 128\n3 0 1 2\n"));
  ASSERT_EQ(model.Triangles.size(), 1U);
  const auto& reflectance = model.Triangles[0].Reflectance;
  EXPECT_NEAR(reflectance[0], 1.0, 1e-6);
  EXPECT_NEAR(reflectance[1], 1.0 / 3.0, 1e-6);
  EXPECT_NEAR(reflectance[2], LinearFromSrgb(128.0 / 255.0), 1e-6);
}

TEST(CadMesh, ColorSpaceOverrules)
{
  CadOptions options;
  options.Colors = ColorSpace::Linear;
  const CadModel obj = Read(Samples + "kiosk.obj", options);
  const CadModel step = Read(Samples + "kiosk.step", options);
  options.Colors = ColorSpace::Srgb;
  const CadModel gltf = Read(Samples + "kiosk.gltf", options);
  const auto plaster = [](const CadModel& model)
  { return *model.Materials.at(model.Triangles.at(0).Material).Reflectance; };
  EXPECT_NEAR(plaster(obj)[1], 0.7, 1e-6);
  EXPECT_NEAR(plaster(step)[1], 0.7, 1e-6);
  EXPECT_NEAR(plaster(gltf)[1], LinearFromSrgb(0.7), 1e-6);
}

TEST(CadMesh, DegenerateTrianglesAreCounted)
{
  const Folder folder("cad-degenerate");
  const CadModel model = Read(folder.Write("flat.obj",
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nv 0 1e-4 0\nf 1 2 3\nf 1 2 4\nf 1 1 3\nf 1 2 5\n"));
  // The sliver of 0.1 mm stays.
  EXPECT_EQ(model.Triangles.size(), 2U);
  EXPECT_EQ(model.DegenerateTriangles, 2U);
}

TEST(CadMesh, ObjOfOtherHabits)
{
  const Folder folder("obj-habits");
  // The plain triangle has an area of 1/16; a lost vertex would make it another one.
  const std::string rest = "v 9 9 9\nv 8 7 9\nv 7 7 7\n";
  for (const std::string& text : {"v 0 0 0\nv 0.5 0 0\nv 0 0.25 0\n" + rest + "f 1 2 3\n",
         "v 0 0 0\nv .5 0 0\nv 0 .25 0\n" + rest + "f 1 2 3\n",
         "v 0 0 0\r\nv\t.5\t0 -.0\r\nv 0 +.25 0\r\n" + rest + "f 1 2 3\r\n",
         "v 0 0 0 # one\nv 5e-1 0 0 #2\nv 0 .25 0\n" + rest + "f 1 2 3 # face 1.5\n",
         "v 0 0 0\nv .5 0 0\nv 0 .25 0\n" + rest + "o a.b #3\nf 1 2 3"})
  {
    const CadModel model = Read(folder.Write("a.obj", text));
    ASSERT_EQ(model.Triangles.size(), 1U) << text;
    EXPECT_NEAR(MeasureObject(model).Area, 1.0 / 16.0, 1e-9) << text;
  }
  // Names keep their points and signs.
  const CadModel model =
    Read(folder.Write("b.obj", "o .a#3\nv .5 0 0\nv 0 0 0\nv 0 1 0\nf 1 2 3 # last\n"));
  EXPECT_EQ(model.Objects.at(0).Name, ".a#3");
}

TEST(CadMesh, PipesAreNotWaitedFor)
{
  const Folder folder("obj-pipe");
  ASSERT_EQ(::mkfifo(folder.Path("a.mtl").c_str(), 0600), 0);
  const CadModel model =
    Read(folder.Write("a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
  ASSERT_EQ(model.Warnings.size(), 1U);
  EXPECT_NE(model.Warnings[0].find("'a.mtl'"), std::string::npos);
}

TEST(CadMesh, MissingMaterialFileIsSaid)
{
  const Folder folder("cad-mtl");
  const CadModel model = Read(folder.Write("kiosk.obj", Bytes(Samples + "kiosk.obj")));
  EXPECT_THAT(model.Warnings, testing::ElementsAre(testing::HasSubstr("'kiosk.mtl'")));
  // Only what the model names is missing, not what is looked for in its place.
  const CadModel other = Read(folder.Write("other.obj", Bytes(Samples + "kiosk.obj")));
  EXPECT_THAT(other.Warnings, testing::ElementsAre(testing::HasSubstr("'kiosk.mtl'")));
  for (const CadMaterial& material : model.Materials)
  {
    EXPECT_FALSE(material.Reflectance.has_value()) << material.Name;
  }
}

TEST(CadMesh, FarFromTheOriginIsSaid)
{
  const Folder folder("cad-far");
  const CadModel model =
    Read(folder.Write("far.obj", "v 500000 0 0\nv 500001 0 0\nv 500000 1 0\nf 1 2 3\n"));
  EXPECT_THAT(model.Warnings, testing::ElementsAre(testing::HasSubstr("500001 m from the origin")));
}

} // namespace
} // namespace smokevis::test
