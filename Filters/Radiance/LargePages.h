// Memory in large pages.
#pragma once

#include <cstddef>
#include <vector>

namespace smokevis
{

/// Asks the system to back memory that nothing was written to yet with large pages, where it has
/// them: what is read here and there in much memory else waits for the tables of small ones. Does
/// nothing on systems that are not asked that way, and to memory of less than a large page.
void BackWithLargePages(const void* begin, std::size_t bytes);

/// The same of a vector's room, which is made for so many elements in all.
template <class Value> void ReserveInLargePages(std::size_t count, std::vector<Value>& values)
{
  if (count > values.capacity())
  {
    values.reserve(count);
    BackWithLargePages(values.data() + values.size(), (count - values.size()) * sizeof(Value));
  }
}

} // namespace smokevis
