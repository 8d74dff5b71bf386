// Reads STEP and IGES through Open CASCADE, with the colours and names of its extended data
// exchange.
#include "BRepModel.h"

#include "BRepSession.h"
#include "Errors.h"
#include "SrgbColor.h"

#include <BRepMesh_IncrementalMesh.hxx>
#include <BRep_Tool.hxx>
#include <IFSelect_ReturnStatus.hxx>
#include <IGESCAFControl_Reader.hxx>
#include <IGESData_GlobalSection.hxx>
#include <IGESData_IGESModel.hxx>
#include <IMeshTools_Parameters.hxx>
#include <Interface_Check.hxx>
#include <Interface_CheckIterator.hxx>
#include <Message_ProgressScope.hxx>
#include <RWMesh_FaceIterator.hxx>
#include <STEPCAFControl_Reader.hxx>
#include <TColStd_SequenceOfAsciiString.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TDF_LabelSequence.hxx>
#include <TDataStd_Name.hxx>
#include <TDataStd_TreeNode.hxx>
#include <TDocStd_Document.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XCAFApp_Application.hxx>
#include <XCAFDoc.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_Material.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <XCAFPrs_DocumentExplorer.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <numbers>
#include <tuple>
#include <utility>

namespace smokevis
{
namespace
{

constexpr double Millimetre = 0.001;

/// An empty document, closed at the end.
class Document
{
public:
  Document() : Application_(XCAFApp_Application::GetApplication())
  {
    this->Application_->NewDocument("BinXCAF", this->Document_);
  }
  ~Document() { this->Application_->Close(this->Document_); }
  Document(const Document&) = delete;
  Document& operator=(const Document&) = delete;

  Handle(TDocStd_Document) & Get() { return this->Document_; }

private:
  Handle(XCAFApp_Application) Application_;
  Handle(TDocStd_Document) Document_;
};

/// Length [m] of a unit by its name in STEP, or 0.
double StepUnit(std::string name)
{
  std::transform(name.begin(), name.end(), name.begin(),
    [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  static const std::map<std::string, double> lengths = {{"METRE", 1.0}, {"METER", 1.0},
    {"MILLIMETRE", 1e-3}, {"MILLIMETER", 1e-3}, {"CENTIMETRE", 1e-2}, {"CENTIMETER", 1e-2},
    {"DECIMETRE", 0.1}, {"DECIMETER", 0.1}, {"KILOMETRE", 1e3}, {"KILOMETER", 1e3},
    {"MICROMETRE", 1e-6}, {"MICROMETER", 1e-6}, {"INCH", 0.0254}, {"FOOT", 0.3048},
    {"YARD", 0.9144}, {"MILE", 1609.344}};
  const auto found = lengths.find(name);
  return found == lengths.end() ? 0.0 : found->second;
}

[[noreturn]] void Refuse(const std::string& fileName, const CadModel& model,
  const BRepSession& session, const std::string& what)
{
  throw Error(fileName,
    what + " as " + model.Format +
      (session.Messages().empty() ? "" : " (" + session.Messages() + ")"),
    "Check that the file is complete, or export it again");
}

/// The entities with failures in a list of checks, and the first of what was said about them.
void CountFailures(const Interface_CheckIterator& checks, int& entities, std::string& first)
{
  Interface_CheckIterator check = checks;
  for (check.Start(); check.More(); check.Next())
  {
    const Handle(Interface_Check)& report = check.Value();
    if (report->HasFailed())
    {
      ++entities;
      if (first.empty())
      {
        first = report->CFail(1);
        if (check.Number() > 0)
        {
          first = "entity " + std::to_string(check.Number()) + ": " + first;
        }
      }
    }
  }
}

/// Says so where a part of the file was not understood: the model is then not all of it.
void WarnOfFailures(XSControl_Reader& reader, CadModel& model)
{
  const Handle(XSControl_WorkSession) session = reader.WS();
  int entities = 0;
  std::string first;
  CountFailures(session->ModelCheckList(), entities, first);
  CountFailures(session->TransferReader()->TransientProcess()->CheckList(false), entities, first);
  if (entities > 0)
  {
    model.Warnings.push_back(
      std::to_string(entities) +
      " entities of the file are damaged or not understood, so parts may be missing (first: " +
      first + "); compare ModelBounds and the picture with the CAD program");
  }
}

void ReadStep(const std::string& fileName, const BRepSession& session,
  const Message_ProgressRange& progress, Document& document, CadModel& model)
{
  STEPCAFControl_Reader reader;
  reader.SetColorMode(true);
  reader.SetNameMode(true);
  reader.SetMatMode(true);
  if (reader.ReadFile(fileName.c_str()) != IFSelect_RetDone)
  {
    Refuse(fileName, model, session, "it cannot be read");
  }
  TColStd_SequenceOfAsciiString lengths, angles, solidAngles;
  reader.ChangeReader().FileUnits(lengths, angles, solidAngles);
  if (lengths.Length() > 0)
  {
    const double unit = StepUnit(lengths.First().ToCString());
    if (unit > 0.0)
    {
      model.UnitScale = unit;
      model.UnitSource = CadSource::File;
    }
  }
  if (!reader.Transfer(document.Get(), progress))
  {
    Refuse(fileName, model, session, "it holds no shape that can be read");
  }
  WarnOfFailures(reader.ChangeReader(), model);
}

void ReadIges(const std::string& fileName, const BRepSession& session,
  const Message_ProgressRange& progress, Document& document, CadModel& model)
{
  IGESCAFControl_Reader reader;
  reader.SetColorMode(true);
  reader.SetNameMode(true);
  if (reader.ReadFile(fileName.c_str()) != IFSelect_RetDone)
  {
    Refuse(fileName, model, session, "it cannot be read");
  }
  const double unit = reader.IGESModel()->GlobalSection().UnitValue();
  if (unit > 0.0)
  {
    model.UnitScale = unit * Millimetre;
    model.UnitSource = CadSource::File;
  }
  if (!reader.Transfer(document.Get(), progress))
  {
    Refuse(fileName, model, session, "it holds no shape that can be read");
  }
  WarnOfFailures(reader, model);
}

std::string NameOf(const TDF_Label& label)
{
  Handle(TDataStd_Name) name;
  if (!label.FindAttribute(TDataStd_Name::GetID(), name))
  {
    return {};
  }
  std::string text(static_cast<std::size_t>(name->Get().LengthOfCString()), '\0');
  Standard_PCharacter buffer = text.data();
  name->Get().ToUTF8CString(buffer);
  return text;
}

/// Names that programs make up for places in an assembly.
bool IsMadeUp(const std::string& name)
{
  return name.empty() || name.compare(0, 2, "=>") == 0 || name.compare(0, 4, "NAUO") == 0 ||
         name.find_first_not_of("0123456789") == std::string::npos;
}

/// Gathers the faces of a document.
class FaceCollector
{
public:
  FaceCollector(CadModel& model, ColorSpace colors, double unitsPerMillimetre)
      : Model_(model), Colors_(colors), Units_(unitsPerMillimetre)
  {
  }

  void Add(const XCAFPrs_DocumentExplorer& explorer)
  {
    const XCAFPrs_DocumentNode& node = explorer.Current();
    CadObject object;
    for (int depth = 0; depth < explorer.CurrentDepth(); ++depth)
    {
      const XCAFPrs_DocumentNode& parent = explorer.Current(depth);
      for (const std::string& name : {NameOf(parent.RefLabel), NameOf(parent.Label)})
      {
        if (!IsMadeUp(name) && (object.Groups.empty() || object.Groups.back() != name))
        {
          object.Groups.push_back(name);
        }
      }
    }
    const std::string own = NameOf(node.Label);
    const std::string product = NameOf(node.RefLabel);
    object.Name = IsMadeUp(own) ? product : own;
    if (product != object.Name && !product.empty())
    {
      object.Groups.push_back(product);
    }
    this->Model_.Objects.push_back(std::move(object));

    const std::string material = MaterialName(node.RefLabel);
    for (RWMesh_FaceIterator face(node.RefLabel, node.Location, true, node.Style); face.More();
         face.Next())
    {
      if (!face.IsEmptyMesh())
      {
        this->AddFace(face, this->MaterialIndex(material, face));
      }
    }
    const TopoDS_Shape shape = XCAFDoc_ShapeTool::GetShape(node.RefLabel);
    for (TopExp_Explorer faces(shape, TopAbs_FACE); faces.More(); faces.Next())
    {
      TopLoc_Location location;
      this->Failed_ += BRep_Tool::Triangulation(TopoDS::Face(faces.Current()), location).IsNull();
    }
  }

  std::size_t Failed() const { return this->Failed_; }

private:
  static std::string MaterialName(const TDF_Label& label)
  {
    Handle(TDataStd_TreeNode) node;
    Handle(XCAFDoc_Material) material;
    if (label.FindAttribute(XCAFDoc::MaterialRefGUID(), node) && node->HasFather() &&
        node->Father()->Label().FindAttribute(XCAFDoc_Material::GetID(), material) &&
        !material->GetName().IsNull())
    {
      return material->GetName()->ToCString();
    }
    return {};
  }

  std::int32_t MaterialIndex(const std::string& name, const RWMesh_FaceIterator& face)
  {
    using Key = std::tuple<std::string, bool, std::array<double, 3>, float>;
    Key key{name, face.HasFaceColor(), {}, 1.0F};
    CadMaterial material;
    material.Name = name;
    if (face.HasFaceColor())
    {
      // Open CASCADE takes the numbers of the file for sRGB and holds linear ones.
      std::array<double, 3> srgb{};
      CadColor linear{};
      const Quantity_Color& color = face.FaceColor().GetRGB();
      color.Values(srgb[0], srgb[1], srgb[2], Quantity_TOC_sRGB);
      for (int i = 0; i < 3; ++i)
      {
        srgb[i] = std::clamp(srgb[i], 0.0, 1.0);
        linear[i] = this->Colors_ == ColorSpace::Linear ? srgb[i] : LinearFromSrgb(srgb[i]);
      }
      material.Reflectance = linear;
      material.Opacity = face.FaceColor().Alpha();
      if (material.Name.empty())
      {
        char hex[8];
        std::snprintf(hex, sizeof hex, "#%02X%02X%02X",
          static_cast<unsigned>(std::lround(255.0 * srgb[0])),
          static_cast<unsigned>(std::lround(255.0 * srgb[1])),
          static_cast<unsigned>(std::lround(255.0 * srgb[2])));
        material.Name = hex;
      }
      std::get<2>(key) = srgb;
      std::get<3>(key) = face.FaceColor().Alpha();
    }
    const auto next = static_cast<std::int32_t>(this->Model_.Materials.size());
    const auto [found, added] = this->Materials_.emplace(key, next);
    if (added)
    {
      this->Model_.Materials.push_back(std::move(material));
    }
    return found->second;
  }

  void AddFace(const RWMesh_FaceIterator& face, std::int32_t material)
  {
    const std::size_t first = this->Model_.Points.size();
    if (first + face.NbNodes() > std::numeric_limits<std::uint32_t>::max())
    {
      throw Error("tessellation", "it has more points than can be numbered",
        "Raise LinearTolerance and AngularTolerance");
    }
    for (int i = face.NodeLower(); i <= face.NodeUpper(); ++i)
    {
      const gp_Pnt point = face.NodeTransformed(i);
      this->Model_.Points.push_back(
        {this->Units_ * point.X(), this->Units_ * point.Y(), this->Units_ * point.Z()});
    }
    const auto offset = static_cast<std::uint32_t>(first) - face.NodeLower();
    const auto object = static_cast<std::int32_t>(this->Model_.Objects.size()) - 1;
    for (int i = face.ElemLower(); i <= face.ElemUpper(); ++i)
    {
      int a, b, c;
      face.TriangleOriented(i).Get(a, b, c);
      this->Model_.Triangles.push_back({{offset + a, offset + b, offset + c}, material, object});
    }
  }

  CadModel& Model_;
  ColorSpace Colors_;
  double Units_;
  std::map<std::tuple<std::string, bool, std::array<double, 3>, float>, std::int32_t> Materials_;
  std::size_t Failed_ = 0;
};

void Tessellate(
  Document& document, double linear, double angular, const Message_ProgressRange& progress)
{
  TDF_LabelSequence roots;
  XCAFDoc_DocumentTool::ShapeTool(document.Get()->Main())->GetFreeShapes(roots);
  IMeshTools_Parameters parameters;
  parameters.Deflection = linear;
  parameters.Angle = angular;
  parameters.InParallel = true;
  Message_ProgressScope scope(progress, nullptr, std::max(1, roots.Length()));
  for (const TDF_Label& root : roots)
  {
    const TopoDS_Shape shape = XCAFDoc_ShapeTool::GetShape(root);
    if (scope.UserBreak() || shape.IsNull())
    {
      continue;
    }
    BRepMesh_IncrementalMesh(shape, parameters, scope.Next());
  }
}

void ReadModel(const std::string& fileName, const CadOptions& options, Progress& progress,
  const BRepSession& session, CadModel& model)
{
  const Handle(BRepProgress) indicator = new BRepProgress(progress);
  Message_ProgressScope scope(indicator->Start(), nullptr, 2);
  Document document;
  if (model.Format == "STEP")
  {
    ReadStep(fileName, session, scope.Next(), document, model);
  }
  else
  {
    ReadIges(fileName, session, scope.Next(), document, model);
  }
  const double unitsPerMillimetre = Millimetre / model.UnitScale;
  const double metresPerUnit = options.UnitScale > 0.0 ? options.UnitScale : model.UnitScale;
  Tessellate(document, options.LinearTolerance / (metresPerUnit * unitsPerMillimetre),
    options.AngularTolerance * std::numbers::pi / 180.0, scope.Next());
  if (progress.ShouldStop())
  {
    return;
  }
  FaceCollector faces(model, options.Colors, unitsPerMillimetre);
  XCAFPrs_DocumentExplorer explorer(
    document.Get(), XCAFPrs_DocumentExplorerFlags_OnlyLeafNodes, XCAFPrs_Style());
  for (; explorer.More(); explorer.Next())
  {
    faces.Add(explorer);
  }
  if (faces.Failed() > 0)
  {
    model.Warnings.push_back(
      std::to_string(faces.Failed()) +
      " faces could not be tessellated and are missing; repair them in the CAD program");
  }
}

} // namespace

//------------------------------------------------------------------------------------------------
void ReadBRepModel(
  const std::string& fileName, const CadOptions& options, Progress& progress, CadModel& model)
{
  const BRepSession session;
  const std::string failure =
    session.Run([&]() { ReadModel(fileName, options, progress, session, model); });
  if (!failure.empty())
  {
    throw Error(fileName, "Open CASCADE failed on it (" + failure + ")",
      "Check that the file is complete, or export it again");
  }
}

} // namespace smokevis
