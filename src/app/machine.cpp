#include "src/app/machine.h"

#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>

#include "src/app/formatted.h"
#include "src/core/errors.h"

namespace promenade::app {

double availableMemoryBytes() {
  double bytes = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
  for (const char* file : {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"}) {
    std::ifstream limit(file);
    double value = 0.0;
    if (limit >> value && value > 0.0) bytes = std::min(bytes, value);
  }
  return bytes;
}

double peakResidentBytes() {
  rusage usage{};
  if (getrusage(RUSAGE_SELF, &usage) != 0) return 0.0;
  return static_cast<double>(usage.ru_maxrss) * 1024.0;
}

void keepFreedMemory() {
  // Larger maps than 32 MiB, the most that the C library takes here, go back to the system as before.
  (void)mallopt(M_MMAP_THRESHOLD, 32 << 20);
  (void)mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
}

std::string gigabytes(double bytes) {
  return formatted("%.1f GB", bytes / 1e9);
}

void requireMemory(double neededBytes, double availableBytes) {
  if (neededBytes <= availableBytes) return;
  throw InputError("--size, --supersample: the frames of this job need " + gigabytes(neededBytes) +
                   " of memory and this machine has " + gigabytes(availableBytes) +
                   "; choose a smaller size or less supersampling");
}

}  // namespace promenade::app
