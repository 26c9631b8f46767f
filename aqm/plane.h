#pragma once
// The working buffer of the metric: rows that start on a cache line and are zero-padded to whole SIMD
// vectors, so that inner loops have no tails. Maps (src/core/image.h) are the values that enter and leave;
// planes never do.

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>

namespace promenade::aqm {

/// Every row's length is rounded up to a multiple of this many elements.
inline constexpr int kPlaneUnit = 32;

template <class T>
class Plane {
  static_assert(std::is_trivially_destructible_v<T>);

 public:
  Plane() = default;
  /// All zero.
  Plane(int width, int height)
      : width_(width), height_(height), stride_((width + kPlaneUnit - 1) / kPlaneUnit * kPlaneUnit) {
    const std::size_t count = static_cast<std::size_t>(stride_) * static_cast<std::size_t>(height_);
    elements_.reset(new (std::align_val_t{64}) T[count]());
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
    void operator()(T* elements) const { ::operator delete[](elements, std::align_val_t{64}); }
  };
  [[nodiscard]] std::size_t offset(int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(stride_);
  }

  int width_ = 0;
  int height_ = 0;
  int stride_ = 0;
  std::unique_ptr<T[], Deleter> elements_;
};

}  // namespace promenade::aqm
