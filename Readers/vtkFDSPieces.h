// Which meshes a process reads, and how processes hand each other what they read.
#ifndef vtkFDSPieces_h
#define vtkFDSPieces_h

#include <chrono>
#include <cstdint>
#include <vector>

class vtkFieldData;
class vtkInformation;
class vtkPartitionedDataSetCollection;

namespace smokevis
{

class SmvFile;
struct FlameLight;

/// What reading takes this process: made when it begins, ended when it has ended.
class ReadingShare
{
public:
  /// @param bytesRead of all files so far
  explicit ReadingShare(std::uint64_t bytesRead) : bytes_(bytesRead) {}
  void End(std::uint64_t bytesRead)
  {
    bytes_ = bytesRead - bytes_;
    seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  double Seconds() const { return seconds_; }
  std::uint64_t Bytes() const { return bytes_; }

private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  double seconds_ = 0.0;
  std::uint64_t bytes_;
};

/// The part of a run's meshes that is to be read here.
///
/// Who asks for one of several pieces gets its share of the meshes. Who asks for the whole in a
/// parallel run gets the whole, too, but each process reads only its share from disk and receives
/// the rest from the others: all of them must ask together, as the filters of a parallel pipeline
/// do.
class FDSPieces
{
public:
  /// @param output information of the output that is asked for
  FDSPieces(const SmvFile& index, vtkInformation* output);

  /// Meshes [First, End) are read here.
  int First() const { return first_; }
  int End() const { return end_; }
  /// Whether this is the piece that has what is not divided by meshes.
  bool IsFirstPiece() const { return piece_ == 0; }

  enum class Outcome
  {
    Good,
    Aborted,
    Failed
  };

  /// What came out over all processes: the worst. Every process must call this, whatever happened
  /// to it, before any of those below.
  Outcome Agree(Outcome own) const;

  /// Sums over all processes. @p meshes has an entry a mesh, filled for those read here; they are
  /// added in the order of the meshes, so the result does not depend on the number of processes.
  FlameLight Sum(const std::vector<FlameLight>& meshes) const;

  /// Adds to the work report in @p fields what reading took each process.
  void ReportShares(const ReadingShare& own, vtkFieldData* fields) const;

  /// Completes the collection by the blocks that other processes read.
  /// @param owners process that has each block
  void Complete(vtkPartitionedDataSetCollection* blocks, const std::vector<int>& meshOfBlock) const;

private:
  std::vector<double> Each(double own) const;
  int Owner(int mesh) const;

  std::vector<int> begins_; // first mesh of each piece, and the number of meshes
  int first_ = 0;
  int end_ = 0;
  int piece_ = 0;
  // Processes that work together on this request; 1 where each is on its own.
  int processes_ = 1;
  bool exchanges_ = false;
};

} // namespace smokevis

#endif
