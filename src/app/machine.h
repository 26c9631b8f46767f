#pragma once
// What the machine has.

#include <string>

namespace promenade::app {

/// Bytes of memory that this process may use: physical memory, or the limit of its control group if lower.
[[nodiscard]] double availableMemoryBytes();

/// Most memory that this process held so far.
[[nodiscard]] double peakResidentBytes();

/// From now on memory that was freed stays with the process for what comes next: the maps of every frame are
/// of the same sizes, and the system would clear each page of them again. (3 to 5 per cent of a walk.)
void keepFreedMemory();

/// "1.5 GB"
[[nodiscard]] std::string gigabytes(double bytes);

/// Throws InputError with both numbers if a job needs more memory than there is.
void requireMemory(double neededBytes, double availableBytes);

}  // namespace promenade::app
