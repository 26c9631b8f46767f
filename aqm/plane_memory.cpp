#include "aqm/plane_memory.h"

#include <sys/mman.h>

#include <cstdint>
#include <cstring>
#include <new>

namespace promenade::aqm {
namespace {

/// Of x86-64 and of most others.
constexpr std::size_t kHugePage = std::size_t{2} << 20;
constexpr std::align_val_t kCacheLine{64};

constexpr std::size_t wholePages(std::size_t bytes) {
  return (bytes + kHugePage - 1) / kHugePage * kHugePage;
}

}  // namespace

void* zeroedMemory(std::size_t bytes) {
  if (bytes < kHugePage) {
    void* memory = ::operator new(bytes, kCacheLine);
    std::memset(memory, 0, bytes);
    return memory;
  }
  // One page more than needed, of which what lies before and after the aligned block is given back.
  const std::size_t length = wholePages(bytes);
  void* mapped =
      mmap(nullptr, length + kHugePage, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (mapped == MAP_FAILED) throw std::bad_alloc();
  auto* const begin = static_cast<char*>(mapped);
  const std::size_t past = reinterpret_cast<std::uintptr_t>(mapped) % kHugePage;
  const std::size_t before = (kHugePage - past) % kHugePage;
  if (before > 0) munmap(begin, before);
  munmap(begin + before + length, kHugePage - before);
  // A wish: without huge pages it is memory all the same.
  static_cast<void>(madvise(begin + before, length, MADV_HUGEPAGE));
  return begin + before;
}

void freeMemory(void* memory, std::size_t bytes) {
  if (bytes < kHugePage) {
    ::operator delete(memory, kCacheLine);
  } else {
    munmap(memory, wholePages(bytes));
  }
}

}  // namespace promenade::aqm
