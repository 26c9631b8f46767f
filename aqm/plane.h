#pragma once
// The working buffer of the metric: rows that start on a cache line and are zero-padded to whole SIMD
// vectors, so that inner loops have no tails. Maps (src/core/image.h) are the values that enter and leave;
// planes never do.

#include <cstddef>
#include <memory>
#include <type_traits>

#include "aqm/plane_memory.h"

namespace promenade::aqm {

/// Every row's length is rounded up to a multiple of this many elements.
inline constexpr int kPlaneUnit = 32;

template <class T>
class Plane {
  // Numbers whose zero is made of zero bits.
  static_assert(std::is_trivially_destructible_v<T> && std::is_trivially_copy_constructible_v<T>);

 public:
  Plane() = default;
  /// All zero.
  Plane(int width, int height)
      : width_(width), height_(height), stride_((width + kPlaneUnit - 1) / kPlaneUnit * kPlaneUnit) {
    const std::size_t bytes =
        sizeof(T) * static_cast<std::size_t>(stride_) * static_cast<std::size_t>(height_);
    elements_ = Elements(static_cast<T*>(zeroedMemory(bytes)), Deleter{bytes});
  }

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  /// Elements from one row to the next.
  [[nodiscard]] int stride() const { return stride_; }

  /// `stride()` elements may be read and written.
  T* row(int y) { return elements_.get() + offset(y); }
  const T* row(int y) const { return elements_.get() + offset(y); }

 private:
  struct Deleter {
    std::size_t bytes = 0;
    void operator()(T* elements) const { freeMemory(elements, bytes); }
  };
  using Elements = std::unique_ptr<T[], Deleter>;
  [[nodiscard]] std::size_t offset(int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(stride_);
  }

  int width_ = 0;
  int height_ = 0;
  int stride_ = 0;
  Elements elements_;
};

}  // namespace promenade::aqm
