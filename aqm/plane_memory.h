#pragma once
// Where planes live. The metric fills and drops some hundred megabytes a call: taken page by page, that alone
// would be a tenth of its time.

#include <cstddef>

namespace promenade::aqm {

/// `bytes` of zeros, aligned to a cache line. Large blocks come from the system as they are first touched, on
/// huge pages where it has them. Throws std::bad_alloc.
[[nodiscard]] void* zeroedMemory(std::size_t bytes);
/// `bytes` as asked for.
void freeMemory(void* memory, std::size_t bytes);

}  // namespace promenade::aqm
