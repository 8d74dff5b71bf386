// Writes CAD files with Open CASCADE, reads them, and measures models.
#include "CadSamples.h"

#include "CadFile.h"

#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <IGESCAFControl_Writer.hxx>
#include <IGESControl_Controller.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Quantity_ColorRGBA.hxx>
#include <STEPCAFControl_Writer.hxx>
#include <STEPControl_Controller.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Document.hxx>
#include <XCAFApp_Application.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <gp_Trsf.hxx>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <stdexcept>

namespace smokevis::test
{
namespace
{

constexpr double Metre = 1000.0;

gp_Pnt Point(double x, double y, double z)
{
  return {Metre * x, Metre * y, Metre * z};
}

TopoDS_Shape Quad(const gp_Pnt& a, const gp_Pnt& b, const gp_Pnt& c, const gp_Pnt& d)
{
  return BRepBuilderAPI_MakeFace(BRepBuilderAPI_MakePolygon(a, b, c, d, true).Wire()).Shape();
}

void Write(
  const Handle(TDocStd_Document) & document, const std::string& fileName, const std::string& unit)
{
  Message::DefaultMessenger()->ChangePrinters().Clear();
  STEPControl_Controller::Init();
  IGESControl_Controller::Init();
  bool good = false;
  if (std::filesystem::path(fileName).extension() == ".igs")
  {
    Interface_Static::SetCVal("write.iges.unit", unit.c_str());
    Interface_Static::SetIVal("write.iges.brep.mode", 1);
    IGESCAFControl_Writer writer;
    good = writer.Perform(document, fileName.c_str());
  }
  else
  {
    Interface_Static::SetCVal("write.step.unit", unit.c_str());
    STEPCAFControl_Writer writer;
    good = writer.Perform(document, fileName.c_str());
  }
  if (!good)
  {
    throw std::runtime_error("cannot write " + fileName);
  }
}

/// A document to write.
class Building
{
public:
  Building()
  {
    XCAFApp_Application::GetApplication()->NewDocument("BinXCAF", this->Document_);
    this->Shapes_ = XCAFDoc_DocumentTool::ShapeTool(this->Document_->Main());
    this->Colors_ = XCAFDoc_DocumentTool::ColorTool(this->Document_->Main());
    this->Root_ = this->Shapes_->NewShape();
    TDataStd_Name::Set(this->Root_, "Building");
  }
  ~Building() { XCAFApp_Application::GetApplication()->Close(this->Document_); }
  Building(const Building&) = delete;
  Building& operator=(const Building&) = delete;

  /// @param color sRGB and opacity
  void Add(const TopoDS_Shape& shape, const char* name, const std::array<float, 4>& color,
    const gp_Vec& move)
  {
    const TDF_Label label = this->Shapes_->AddShape(shape, false);
    TDataStd_Name::Set(label, name);
    const Quantity_Color opaque(color[0], color[1], color[2], Quantity_TOC_sRGB);
    this->Colors_->SetColor(label, Quantity_ColorRGBA(opaque, color[3]), XCAFDoc_ColorSurf);
    gp_Trsf place;
    place.SetTranslation(move);
    const TDF_Label part = this->Shapes_->AddComponent(this->Root_, label, TopLoc_Location(place));
    TDataStd_Name::Set(part, name);
  }

  void Save(const std::string& fileName, const std::string& unit)
  {
    this->Shapes_->UpdateAssemblies();
    Write(this->Document_, fileName, unit);
  }

private:
  Handle(TDocStd_Document) Document_;
  Handle(XCAFDoc_ShapeTool) Shapes_;
  Handle(XCAFDoc_ColorTool) Colors_;
  TDF_Label Root_;
};

} // namespace

//------------------------------------------------------------------------------------------------
CadModel Read(const std::string& fileName, const CadOptions& options)
{
  Progress progress;
  return ReadCadFile(fileName, options, progress);
}

//------------------------------------------------------------------------------------------------
std::string Bytes(const std::string& fileName)
{
  std::ifstream file(fileName, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

//------------------------------------------------------------------------------------------------
std::string Replaced(std::string text, const std::string& from, const std::string& to)
{
  const std::size_t at = text.find(from);
  if (at == std::string::npos)
  {
    throw std::logic_error("the sample does not hold: " + from);
  }
  return text.replace(at, from.size(), to);
}

//------------------------------------------------------------------------------------------------
void WriteStepCylinder(
  const std::string& fileName, const std::string& unit, double radius, double height)
{
  Building building;
  building.Add(BRepPrimAPI_MakeCylinder(Metre * radius, Metre * height).Shape(), "Column",
    {0.8F, 0.7F, 0.6F, 1.0F}, gp_Vec(0, 0, 0));
  building.Save(fileName, unit);
}

//------------------------------------------------------------------------------------------------
void WriteKiosk(const std::string& fileName)
{
  Building building;
  building.Add(BRepPrimAPI_MakeBox(Metre * 1, Metre * 2, Metre * 3).Shape(), "Kiosk",
    {0.8F, 0.7F, 0.6F, 1.0F}, gp_Vec(Metre * 1, Metre * 2, 0));
  building.Add(Quad(Point(0, 0, 0), Point(0.3, 0, 0), Point(0.3, 0, 0.15), Point(0, 0, 0.15)),
    "ExitSign-03", {0.1F, 0.5F, 0.2F, 1.0F}, gp_Vec(Metre * 1.35, Metre * 1.99, Metre * 2.2));
  building.Add(Quad(Point(3, 2, 1), Point(3, 3, 1), Point(3, 3, 2), Point(3, 2, 2)), "Glazing-1",
    {0.9F, 0.95F, 1.0F, 0.2F}, gp_Vec(0, 0, 0));
  building.Save(fileName, "MM");
}

//------------------------------------------------------------------------------------------------
Measure MeasureObject(const CadModel& model, const std::string& object)
{
  Measure result;
  result.Low.fill(std::numeric_limits<double>::infinity());
  result.High.fill(-std::numeric_limits<double>::infinity());
  for (const CadTriangle& triangle : model.Triangles)
  {
    if (!object.empty() && model.Objects.at(triangle.Object).Name != object)
    {
      continue;
    }
    const CadPoint& a = model.Points.at(triangle.Corners[0]);
    const CadPoint& b = model.Points.at(triangle.Corners[1]);
    const CadPoint& c = model.Points.at(triangle.Corners[2]);
    CadPoint u, v;
    for (int i = 0; i < 3; ++i)
    {
      u[i] = b[i] - a[i];
      v[i] = c[i] - a[i];
      result.Low[i] = std::min({result.Low[i], a[i], b[i], c[i]});
      result.High[i] = std::max({result.High[i], a[i], b[i], c[i]});
    }
    const CadPoint normal = {
      u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    result.Area += 0.5 * std::hypot(normal[0], normal[1], normal[2]);
    result.Volume += (a[0] * normal[0] + a[1] * normal[1] + a[2] * normal[2]) / 6.0;
  }
  return result;
}

} // namespace smokevis::test
