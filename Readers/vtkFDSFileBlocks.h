// An output of the FDS reader with a block a file, such as the 2-D slices.
#ifndef vtkFDSFileBlocks_h
#define vtkFDSFileBlocks_h

#include "FrameTimes.h"
#include "SmvFile.h"
#include "TimedFile.h"

#include "vtkSmartPointer.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

class vtkDataSet;
class vtkInformation;

namespace smokevis
{
class FDSPieces;

/// All files of one kind of a run, one quantity of one mesh each. They are opened when first read.
class FDSFileBlocks
{
public:
  FDSFileBlocks(const FDSFileBlocks&) = delete;
  FDSFileBlocks& operator=(const FDSFileBlocks&) = delete;
  virtual ~FDSFileBlocks() = default;

  /// Reads the files of this process's share of the meshes and hands all over as the output; files
  /// that are missing make empty blocks. All processes that read together must call it. Field data
  /// of a block are Quantity, Unit, File and Time, that of the values [s].
  /// @returns which files could not be read, and why; empty for none
  std::string Publish(double time, TimeInterpolation interpolation, vtkInformation* output);

  /// Files of this process's share of the meshes that are not whole, a line each.
  /// @param opens whether those that were not read yet are opened
  std::vector<std::string> Damages(const FDSPieces& pieces, bool opens);

protected:
  /// @param index must outlive this object
  explicit FDSFileBlocks(const SmvFile& index) : index_(index) {}

  struct Part
  {
    int Mesh = 0;
    /// Of the block, e.g. "TEMPERATURE fine y=1.2".
    std::string Name;
    const SmvQuantity* Quantity = nullptr;
    /// As the index has it.
    std::string FileName;
    /// Where the index lists it among its kind.
    std::size_t Entry = 0;
    std::unique_ptr<TimedFile> File;
    std::unique_ptr<FrameTimes> Times;
  };
  /// Adds a file.
  void Add(Part part) { parts_.push_back(std::move(part)); }

  const SmvFile& Index() const { return index_; }

  /// Opens the file of a part. Throws Error where that fails.
  virtual std::unique_ptr<TimedFile> OpenFile(const Part& part) const = 0;

  /// Makes a data set of a frame's values at @p time [s].
  virtual vtkSmartPointer<vtkDataSet> Build(
    const Part& part, std::span<const float> values, double time) const = 0;

private:
  /// Whether a part is this process's and its file is there.
  bool Has(const Part& part, const FDSPieces& pieces) const;
  void Open(Part& part) const;
  vtkSmartPointer<vtkDataSet> Read(Part& part, double time, TimeInterpolation interpolation) const;
  std::uint64_t BytesRead() const;

  const SmvFile& index_;
  std::vector<Part> parts_;
};

} // namespace smokevis

#endif
