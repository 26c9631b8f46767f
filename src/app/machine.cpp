#include "src/app/machine.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <fstream>

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

std::string gigabytes(double bytes) {
  char text[48];
  std::snprintf(text, sizeof(text), "%.1f GB", bytes / 1e9);
  return text;
}

void requireMemory(double neededBytes, double availableBytes) {
  if (neededBytes <= availableBytes) return;
  throw InputError("--size, --supersample: the frames of this job need " + gigabytes(neededBytes) +
                   " of memory and this machine has " + gigabytes(availableBytes) +
                   "; choose a smaller size or less supersampling");
}

}  // namespace promenade::app
