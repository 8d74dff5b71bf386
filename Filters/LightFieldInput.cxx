// Makes a light field that arrives as VTK data ready for views.
#include "LightFieldInput.h"

#include "Errors.h"
#include "LightFieldArrays.h"
#include "SceneBuilder.h"
#include "SmokeLightArrays.h"

#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkStringArray.h>

#include <algorithm>

namespace smokevis
{
namespace
{

const char* const Remedy = "Give the output of SmokeLightField, or a file that it was saved to";

double NeededNumber(vtkDataObject* input, const char* name, int component = 0)
{
  double value = 0.0;
  if (!FieldNumber(input, name, component, value))
  {
    throw Error("light field", std::string("its field data have no ") + name, Remedy);
  }
  return value;
}

} // namespace

//------------------------------------------------------------------------------
LightFieldInput::~LightFieldInput()
{
  if (ProcessIsEnding())
  {
    static_cast<void>(this->View_.release());
  }
}

//------------------------------------------------------------------------------
const View& LightFieldInput::Get(vtkDataObject* input)
{
  if (!input)
  {
    throw Error("light field", "there is no input", Remedy);
  }
  const vtkMTimeType time = std::max(input->GetMTime(), input->GetUpdateTime());
  if (!this->View_ || this->Input_ != input || this->InputTime_ != time)
  {
    // Set only once all has gone well.
    this->Input_ = nullptr;
    this->Load(input);
    this->Input_ = input;
    this->InputTime_ = time;
  }
  else
  {
    this->Report_ = {{"views set up", 0.0, "the light field did not change"}};
  }
  return *this->View_;
}

//------------------------------------------------------------------------------
SceneDescription DescribeScene(vtkDataObject* lightField, SceneBlocks& blocks)
{
  vtkDataObject* const smoke = FindBlock(lightField, "Smoke");
  if (!smoke)
  {
    throw Error("light field", "it has no block named Smoke", Remedy);
  }
  blocks.Smoke = CollectSmoke(smoke, "Smoke");
  for (SmokeBlock& block : blocks.Smoke)
  {
    block.Refinement = RefinementOf(*block.Grid, block.Name);
  }
  blocks.Surfaces = CollectSurfaces(FindBlock(lightField, "Surfaces"), "Surfaces");
  blocks.Emitters = CollectSurfaces(FindBlock(lightField, "Emitters"), "Emitters");

  SceneOptions options;
  options.Albedo = NeededNumber(lightField, "Albedo");
  // Light fields from elsewhere may know of no sky.
  FieldNumber(lightField, "SkyLuminance", 0, options.Sky);
  options.Bands = NeededNumber(lightField, "Bands") == 3.0 ? 3 : 1;
  for (int band = 0; band < options.Bands; ++band)
  {
    options.ExtinctionScale[band] = NeededNumber(lightField, "ExtinctionScale", band);
  }
  return BuildScene(blocks, options);
}

//------------------------------------------------------------------------------
void LightFieldInput::Load(vtkDataObject* input)
{
  SceneBlocks blocks;
  SceneDescription description = DescribeScene(input, blocks);
  this->Bands_ = description.Bands;
  if (BandsAreEqual(description))
  {
    description.Bands = 1;
  }
  const int bands = description.Bands;
  this->SignNames_ = ReadSignNames(blocks.Emitters);
  const std::vector<vtkDataArray*> arrays = LightArrays(blocks);
  const bool sameLight =
    std::equal(arrays.begin(), arrays.end(), this->Light_.begin(), this->Light_.end(),
      [](vtkDataArray* array, const LightArray& last)
      { return array && array == last.Array && array->GetMTime() == last.Time; });
  // Light fields from elsewhere may tell of none.
  double tolerance = 0.0;
  if (FieldNumber(input, "Tolerance", 0, tolerance) && !(tolerance > 0.0 && tolerance <= 1.0))
  {
    throw Error("light field", "its Tolerance is " + std::to_string(tolerance),
      "Give the one that it was solved to, above 0 and at most 1, or remove it");
  }
  if (this->View_ && sameLight && this->View_->Field().Tolerance == tolerance &&
      this->Scenes_.IsLast(description))
  {
    this->Report_ = {{"views set up", 0.0, "the light field holds what it held before"}};
    return;
  }
  this->View_.reset();
  this->Light_.clear();
  auto scene = this->Scenes_.Make(std::move(description));
  this->Report_ = {{"views set up", 1.0, "the light field is another one"},
    {"search structures built", scene->SharesShapes() ? 0.0 : 1.0,
      scene->SharesShapes() ? "those of the light field before hold the same shapes"
                            : "shapes are new"},
    LeaptAir(scene->Smoke())};
  auto field = std::make_shared<LightField>(LoadLightField(blocks, scene->Smoke(), bands));
  field->Tolerance = tolerance;
  this->View_ = std::make_unique<const View>(std::move(scene), std::move(field));
  for (vtkDataArray* const array : arrays)
  {
    this->Light_.push_back({array, array->GetMTime()});
  }
}

//------------------------------------------------------------------------------
std::string LightFieldInput::SignIds() const
{
  std::string text;
  for (const Sign& sign : this->View_->TheScene().Lights().Signs())
  {
    text += (text.empty() ? "" : ", ") + std::to_string(sign.Id);
  }
  return text.empty() ? "none" : text;
}

//------------------------------------------------------------------------------
bool FieldNumber(vtkDataObject* lightField, const char* name, int component, double& value)
{
  if (vtkFieldData* const fields = lightField ? lightField->GetFieldData() : nullptr)
  {
    vtkDataArray* const array = fields->GetArray(name);
    const vtkIdType count = array ? array->GetNumberOfValues() : 0;
    if (component < count)
    {
      const int width = array->GetNumberOfComponents();
      value = array->GetComponent(component / width, component % width);
      return true;
    }
  }
  for (const Child& child : Children(lightField))
  {
    if (FieldNumber(child.Object, name, component, value))
    {
      return true;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
void AddFieldNumber(vtkDataObject& target, const char* name, std::initializer_list<double> values)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  for (const double value : values)
  {
    array->InsertNextValue(value);
  }
  target.GetFieldData()->AddArray(array);
}

//------------------------------------------------------------------------------
void AddFieldTexts(vtkDataObject& target, const char* name, const std::vector<std::string>& texts)
{
  vtkNew<vtkStringArray> array;
  array->SetName(name);
  for (const std::string& text : texts)
  {
    array->InsertNextValue(text);
  }
  target.GetFieldData()->AddArray(array);
}

//------------------------------------------------------------------------------
void AddWorkReport(vtkDataObject& target, const std::vector<WorkItem>& report)
{
  std::vector<std::string> what, why;
  vtkNew<vtkDoubleArray> count;
  count->SetName("WorkReportCount");
  for (const WorkItem& item : report)
  {
    what.push_back(item.What);
    count->InsertNextValue(item.Count);
    why.push_back(item.Why);
  }
  AddFieldTexts(target, "WorkReportWhat", what);
  target.GetFieldData()->AddArray(count);
  AddFieldTexts(target, "WorkReportWhy", why);
}

} // namespace smokevis
