// The light field that a view filter gets as input, made ready for views and kept while it stays
// the same.
#pragma once

#include "SceneBlocks.h"
#include "SceneKeeper.h"
#include "SignList.h"
#include "View.h"

#include <vtkDataArray.h>
#include <vtkDataObject.h>
#include <vtkWeakPointer.h>

#include <initializer_list>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace smokevis
{

/// Holds the view of the input that it saw last.
class LightFieldInput
{
public:
  LightFieldInput() = default;
  /// Where the process is already ending the view is left to the system: Embree, which it needs to
  /// take itself apart, may be gone by the time that ParaView deletes its last filters.
  ~LightFieldInput();
  LightFieldInput(const LightFieldInput&) = delete;
  LightFieldInput& operator=(const LightFieldInput&) = delete;

  /// The view of a light field; built anew only where the input's content changed. Throws Error
  /// where the input is not the output of SmokeLightField.
  const View& Get(vtkDataObject* input);

  /// Bands that the last input was made with; the view has fewer where they came out equal.
  int Bands() const { return this->Bands_; }
  /// The signs of the last input.
  SignList Signs() const { return ListSigns(this->View_->TheScene(), this->SignNames_); }
  /// The ids of the signs of the last input, for messages.
  std::string SignIds() const;

  /// What the last Get did and kept.
  const std::vector<WorkItem>& Report() const { return this->Report_; }

private:
  /// An array of the light field, without a claim to its memory.
  struct LightArray
  {
    vtkWeakPointer<vtkDataArray> Array;
    vtkMTimeType Time;
  };
  void Load(vtkDataObject* input);

  vtkWeakPointer<vtkDataObject> Input_;
  vtkMTimeType InputTime_ = 0;
  int Bands_ = 1;
  std::map<int, std::string> SignNames_;
  SceneKeeper Scenes_;
  std::vector<LightArray> Light_;
  std::vector<WorkItem> Report_;
  std::unique_ptr<const View> View_;
};

/// Describes the scene of a light field, whose parts `blocks` receives. Throws Error where the
/// input is not the output of SmokeLightField.
SceneDescription DescribeScene(vtkDataObject* lightField, SceneBlocks& blocks);

/// A number of field data of a light field, in the collection's own field data or, where a file
/// format dropped those, in those of a block. Returns false where there is none.
bool FieldNumber(vtkDataObject* lightField, const char* name, int component, double& value);

/// Adds numbers, or texts, as an array of field data.
void AddFieldNumber(vtkDataObject& target, const char* name, std::initializer_list<double> values);
void AddFieldTexts(vtkDataObject& target, const char* name, const std::vector<std::string>& texts);
/// Adds WorkReportWhat, WorkReportCount and WorkReportWhy.
void AddWorkReport(vtkDataObject& target, const std::vector<WorkItem>& report);

} // namespace smokevis
