// The material table: patterns, order of rows, CSV, JSON and errors.
#include "Errors.h"
#include "FormatsTestRun.h"
#include "MaterialTable.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace smokevis::test
{
namespace
{

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string Csv = "# What the architect left open\n"
                        "Name, Reflectance, Luminance, Sign, Sign_name, Drop\n"
                        "*, 0.4,,,,\n"
                        "\n"
                        "Glazing*,,,,, yes\n"
                        "ExitSign-03,, 300, 3, \"Exit, east\",\n"
                        "Lamp?, 0.1 0.2 0.3, 100 200 300, -1,,\n"
                        "Glazing-7,,,,, no\n";

const std::string Json = "[\n"
                         "  {\"name\": \"*\", \"reflectance\": 0.4},\n"
                         "  {\"name\": \"Glazing*\", \"drop\": true},\n"
                         "  {\n"
                         "    \"name\": \"ExitSign-03\", \"luminance\": 300, \"sign\": 3,\n"
                         "    \"sign_name\": \"Exit, east\"\n"
                         "  },\n"
                         "  {\"name\": \"Lamp?\", \"reflectance\": [0.1, 0.2, 0.3],\n"
                         "   \"luminance\": [100, 200, 300], \"sign\": -1},\n"
                         "  {\"name\": \"Glazing-7\", \"drop\": false}\n"
                         "]\n";

CadMaterial Material(const std::string& name)
{
  CadMaterial material;
  material.Name = name;
  return material;
}

std::string Message(const std::string& name, const std::string& text)
{
  const Folder folder("cad-table-error");
  try
  {
    MaterialTable table(folder.Write(name, text));
  }
  catch (const Error& error)
  {
    EXPECT_THAT(error.what(), HasSubstr(name));
    return error.what();
  }
  return "no error";
}

class CadTable : public testing::TestWithParam<std::pair<const char*, const std::string*>>
{
protected:
  const Folder Folder_{"cad-table"};
  const MaterialTable Table{Folder_.Write(GetParam().first, *GetParam().second)};
};

TEST_P(CadTable, SaysWhatToDo)
{
  const CadTreatment wall = this->Table.Find(Material("Plaster"), {"Wall", {}});
  EXPECT_THAT(wall.Reflectance, ElementsAre(0.4));
  EXPECT_FALSE(wall.IsEmitter());
  EXPECT_FALSE(wall.Drop.has_value());

  const CadTreatment sign = this->Table.Find(Material("Green"), {"exitsign-03", {}});
  EXPECT_TRUE(sign.IsEmitter());
  EXPECT_THAT(sign.Luminance, ElementsAre(300.0));
  EXPECT_EQ(sign.SignId, 3);
  EXPECT_EQ(sign.SignName, "Exit, east");
  // From an earlier row that matches too.
  EXPECT_THAT(sign.Reflectance, ElementsAre(0.4));

  const CadTreatment lamp = this->Table.Find(Material("Lamp2"), {"Fixture", {}});
  EXPECT_THAT(lamp.Luminance, ElementsAre(100.0, 200.0, 300.0));
  EXPECT_THAT(lamp.Reflectance, ElementsAre(0.1, 0.2, 0.3));
  EXPECT_EQ(lamp.SignId, -1);
}

TEST_P(CadTable, LaterRowsAndGroupsCount)
{
  EXPECT_EQ(this->Table.Find(Material("Glazing-1"), {"Pane", {}}).Drop, true);
  EXPECT_EQ(this->Table.Find(Material("Glazing-7"), {"Pane", {}}).Drop, false);
  EXPECT_EQ(this->Table.Find(Material(""), {"Pane", {"House", "Glazing west"}}).Drop, true);
}

TEST_P(CadTable, RowsWithoutUseAreListed)
{
  CadModel model;
  model.Materials = {Material("Plaster"), Material("Lamp1")};
  model.Objects = {{"ExitSign-03", {"Glazing-7"}}};
  EXPECT_THAT(this->Table.Unmatched(model), IsEmpty());
  model.Objects = {{"ExitSign-04", {}}};
  const std::vector<std::string> unmatched = this->Table.Unmatched(model);
  ASSERT_EQ(unmatched.size(), 3U);
  const bool isCsv = GetParam().second == &Csv;
  EXPECT_EQ(unmatched[0], isCsv ? "line 5, pattern 'Glazing*'" : "line 3, pattern 'Glazing*'");
  EXPECT_EQ(
    unmatched[1], isCsv ? "line 6, pattern 'ExitSign-03'" : "line 4, pattern 'ExitSign-03'");
  EXPECT_EQ(unmatched[2], isCsv ? "line 8, pattern 'Glazing-7'" : "line 10, pattern 'Glazing-7'");
}

INSTANTIATE_TEST_SUITE_P(Formats, CadTable,
  testing::Values(std::pair("table.csv", &Csv), std::pair("table.json", &Json)),
  [](const auto& table) { return std::string(table.param.second == &Csv ? "Csv" : "Json"); });

TEST(CadTableErrors, OfCsvNameTheLine)
{
  const auto csv = [](const std::string& text) { return Message("t.csv", text); };
  EXPECT_THAT(csv("name,drop\n\nA,maybe\n"), AllOf(HasSubstr("line 3"), HasSubstr("yes or no")));
  EXPECT_THAT(csv("name,reflectance\nA,1.5\n"), AllOf(HasSubstr("line 2"), HasSubstr("0 to 1")));
  EXPECT_THAT(csv("name,reflectance\nA,nan\n"), HasSubstr("line 2"));
  EXPECT_THAT(csv("name,reflectance\nA,0.5 0.5\n"), HasSubstr("2 numbers"));
  EXPECT_THAT(csv("name,luminance\nA,bright\n"), HasSubstr("not a number"));
  EXPECT_THAT(csv("name,luminance\nA,-1\n"), HasSubstr("out of range"));
  EXPECT_THAT(csv("name,sign\nA,1.5\n"), HasSubstr("whole number"));
  EXPECT_THAT(csv("name,sign\nA,-2\n"), HasSubstr("whole number"));
  EXPECT_THAT(csv("name,colour\nA,1\n"), AllOf(HasSubstr("line 1"), HasSubstr("'colour'")));
  EXPECT_THAT(csv("name;drop\nA;yes\n"), HasSubstr("separated by semicolons"));
  EXPECT_THAT(csv("drop\nyes\n"), HasSubstr("column name is missing"));
  EXPECT_THAT(csv("name,drop\n,yes\n"), AllOf(HasSubstr("line 2"), HasSubstr("name is missing")));
  EXPECT_THAT(csv("name,reflectance\nA,0,5\n"), HasSubstr("more fields"));
  EXPECT_THAT(csv("name,drop\n\"A,yes\n"), HasSubstr("double quote"));
  EXPECT_THAT(csv("name,drop,luminance\nA,yes,300\n"), HasSubstr("drops 'A'"));
  EXPECT_THAT(csv("name,drop\n"), HasSubstr("no row"));
  EXPECT_THAT(csv(""), HasSubstr("no row"));
  EXPECT_THROW(MaterialTable("/nowhere/t.csv"), Error);
}

TEST(CadTableErrors, OfJsonNameTheLine)
{
  const auto json = [](const std::string& text) { return Message("t.json", text); };
  EXPECT_THAT(json("[\n {\"name\": \"A\",\n  \"drop\": tru }\n]"),
    AllOf(HasSubstr("line 3"), HasSubstr("not JSON")));
  EXPECT_THAT(json("[\n {\"name\": \"A\"},\n {\"name\": 3}\n]"), HasSubstr("line 3"));
  EXPECT_THAT(json("[\n\n {\"name\": \"A\", \"drop\": \"yes\"}]"),
    AllOf(HasSubstr("line 3"), HasSubstr("true or false")));
  EXPECT_THAT(json("[{\"name\": \"A\", \"reflectance\": [1, 2, 3]}]"), HasSubstr("0 to 1"));
  EXPECT_THAT(json("[{\"name\": \"A\", \"reflectance\": \"x\"}]"), HasSubstr("not a number"));
  EXPECT_THAT(json("[{\"name\": \"A\", \"sign\": 1e300}]"), HasSubstr("whole number"));
  EXPECT_THAT(json("[{\"drop\": true}]"), HasSubstr("name is missing"));
  EXPECT_THAT(json("[{\"name\": \"A\", \"color\": 1}]"), HasSubstr("'color' is not known"));
  EXPECT_THAT(json("{\"name\": \"A\"}"), HasSubstr("array of objects"));
  EXPECT_THAT(json("[3]"), HasSubstr("array of objects"));
  EXPECT_THAT(json("[\n{\"name\": \"A\", \"sign\": 1e999}\n]"),
    AllOf(HasSubstr("line 2"), HasSubstr("not JSON")));
  EXPECT_THAT(json("[]"), HasSubstr("no row"));
  EXPECT_THAT(json(std::string(100000, '[')), HasSubstr("not JSON"));
}

} // namespace
} // namespace smokevis::test
