#include "LargePages.h"

#ifdef __linux__
#include <cstdint>

#include <sys/mman.h>
#include <unistd.h>
#endif

namespace smokevis
{

void BackWithLargePages([[maybe_unused]] const void* begin, [[maybe_unused]] std::size_t bytes)
{
#ifdef __linux__
  // As x86 and most others have them.
  constexpr std::size_t largePage = std::size_t{1} << 21;
  static const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  const auto address = reinterpret_cast<std::uintptr_t>(begin);
  const std::uintptr_t first = (address + page - 1) / page * page;
  const std::uintptr_t end = (address + bytes) / page * page;
  if (bytes >= largePage)
  {
    // A system without them is slower, and no worse.
    (void)madvise(reinterpret_cast<void*>(first), end - first, MADV_HUGEPAGE);
  }
#endif
}

} // namespace smokevis
