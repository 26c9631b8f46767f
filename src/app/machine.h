#pragma once
// What the machine has.

#include <string>

namespace promenade::app {

/// Bytes of memory that this process may use: physical memory, or the limit of its control group if lower.
[[nodiscard]] double availableMemoryBytes();

/// Most memory that this process held so far.
[[nodiscard]] double peakResidentBytes();

/// "1.5 GB"
[[nodiscard]] std::string gigabytes(double bytes);

/// Throws InputError with both numbers if a job needs more memory than there is.
void requireMemory(double neededBytes, double availableBytes);

}  // namespace promenade::app
