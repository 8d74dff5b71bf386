#include "LargePages.h"

#ifdef __linux__
#include <cstdint>

#include <sys/mman.h>
#include <unistd.h>
#endif

namespace smokevis
{

namespace
{

/// As x86 and most others have them.
[[maybe_unused]] constexpr std::size_t LargePage = std::size_t{1} << 21;

} // namespace

void BackWithLargePages([[maybe_unused]] const void* begin, [[maybe_unused]] std::size_t bytes)
{
#ifdef __linux__
  static const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  const auto address = reinterpret_cast<std::uintptr_t>(begin);
  const std::uintptr_t first = (address + page - 1) / page * page;
  const std::uintptr_t end = (address + bytes) / page * page;
  if (bytes >= LargePage)
  {
    // A system without them is slower, and no worse.
    (void)madvise(reinterpret_cast<void*>(first), end - first, MADV_HUGEPAGE);
  }
#endif
}

} // namespace smokevis
