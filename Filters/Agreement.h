// Makes sure that the processes of a parallel run are about to work on the same thing.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

class vtkDataObject;
class vtkInformationVector;

namespace smokevis
{

class Ranks;

/// What a process is given to work on, part by part. Work is divided among processes on the ground
/// that all of them hold the same; where files or properties differ their parts would not fit, and
/// nothing would show it.
class Agreement
{
public:
  explicit Agreement(const Ranks& ranks) : Ranks_(ranks) {}

  /// Sums up data. On its own a process does not.
  /// @param name what a message calls the part
  void Add(const char* name, vtkDataObject* data);
  /// All that is connected to a port.
  void Add(const char* name, vtkInformationVector* port);
  /// A property.
  void Add(const char* name, std::string_view text);
  template <class Value> void Add(const char* name, Value value)
  {
    static_assert(std::is_arithmetic_v<Value>);
    this->Add(name, std::string_view(reinterpret_cast<const char*>(&value), sizeof(value)));
  }
  template <class Value> void Add(const char* name, const Value* values, int count)
  {
    static_assert(std::is_arithmetic_v<Value>);
    this->Add(name, std::string_view(reinterpret_cast<const char*>(values), count * sizeof(Value)));
  }

  /// Throws Error in all processes, naming the parts, where they differ. All of them must call it,
  /// with parts of the same names in the same order.
  void Check() const;

  /// Of the parts so far, in their order; none where a process is on its own.
  const std::vector<std::uint64_t>& Sums() const { return this->Sums_; }

private:
  void AddSum(const char* name, std::uint64_t sum);

  const Ranks& Ranks_;
  std::vector<std::string> Names_;
  std::vector<std::uint64_t> Sums_;
};

} // namespace smokevis
