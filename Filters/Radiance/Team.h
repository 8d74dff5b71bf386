// The processes that work on one problem together, as the solver sees them.
#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

namespace smokevis
{

/// Every process of a team holds the whole problem and takes the same steps in the same order. What
/// takes long of a step is divided into items, each of which one process works out; all of them
/// then have the item's bits from its owner, so that their results are the same. A team of one, as
/// this class itself is, exchanges nothing.
class Team
{
public:
  /// Memory of the same size in every process, of which one has the contents.
  struct Part
  {
    int Owner;
    void* Data;
    std::size_t Bytes;
  };

  virtual ~Team() = default;

  virtual int Rank() const { return 0; }
  virtual int Size() const { return 1; }

  /// Gives all processes what the owner of each part has. All of them must call it, with parts of
  /// the same owners and sizes. Throws Error in all of them where one has failed or was stopped.
  virtual void Share(const std::vector<Part>& parts) { static_cast<void>(parts); }

  /// Neighbouring items, which cost about the same, have different owners.
  int OwnerOf(std::size_t item) const { return static_cast<int>(item % this->Size()); }
  bool IsOwn(std::size_t item) const { return this->OwnerOf(item) == this->Rank(); }
  /// How many of so many items a process has, and which the i-th of its own is.
  std::size_t OwnCount(std::size_t items, int rank) const
  {
    return (items + this->Size() - 1 - rank) / this->Size();
  }
  std::size_t OwnCount(std::size_t items) const { return this->OwnCount(items, this->Rank()); }
  std::size_t OwnItem(std::size_t i) const { return i * this->Size() + this->Rank(); }

  template <class Value> static Part PartOf(int owner, Value* first, std::size_t count)
  {
    static_assert(std::is_trivially_copyable_v<Value>);
    return {owner, first, count * sizeof(Value)};
  }

  /// Completes values that lie scattered, so that they are packed on the way (which takes as much
  /// memory once more): visit(item, take) calls take(value) for each of the values of an item.
  template <class Value, class Visit> void Complete(std::size_t items, Visit&& visit);

  /// Sum over all processes, in the order of their ranks.
  template <class Value> Value Sum(Value own);
};

template <class Value, class Visit> void Team::Complete(std::size_t items, Visit&& visit)
{
  if (this->Size() == 1)
  {
    return;
  }
  std::vector<std::vector<Value>> packed(this->Size());
  for (std::size_t item = 0; item < items; ++item)
  {
    visit(item, [&to = packed[this->OwnerOf(item)]](Value& value) { to.push_back(value); });
  }
  std::vector<Part> parts;
  for (int rank = 0; rank < this->Size(); ++rank)
  {
    parts.push_back(PartOf(rank, packed[rank].data(), packed[rank].size()));
  }
  this->Share(parts);
  std::vector<std::size_t> next(this->Size(), 0);
  for (std::size_t item = 0; item < items; ++item)
  {
    const int owner = this->OwnerOf(item);
    visit(item, [&](Value& value) { value = packed[owner][next[owner]++]; });
  }
}

template <class Value> Value Team::Sum(Value own)
{
  std::vector<Value> values(this->Size(), own);
  std::vector<Part> parts;
  for (int rank = 0; rank < this->Size(); ++rank)
  {
    parts.push_back(PartOf(rank, &values[rank], 1));
  }
  this->Share(parts);
  Value sum{};
  for (const Value& value : values)
  {
    sum += value;
  }
  return sum;
}

} // namespace smokevis
