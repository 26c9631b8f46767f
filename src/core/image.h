#pragma once
// Images and maps: row-major, origin top left, the centre of pixel (x, y) at (x + 0.5, y + 0.5).

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace promenade {

struct Size {
  int width = 0;
  int height = 0;
  friend bool operator==(const Size&, const Size&) = default;
  [[nodiscard]] std::size_t area() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
};

/// As people write sizes: "640x360".
[[nodiscard]] inline std::string toString(Size size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

/// A row-major raster. Copying is explicit (clone()), because an accidental copy of a frame is never wanted.
/// Precondition of every access: 0 <= x < width(), 0 <= y < height().
template <class T>
class Image {
 public:
  using value_type = T;

  Image() = default;
  explicit Image(Size size, T fill = T{}) : size_(size), pixels_(size.area(), fill) {
    assert(size.width >= 0 && size.height >= 0);
  }
  Image(int width, int height, T fill = T{}) : Image(Size{width, height}, fill) {}

  /// A moved-from image is empty: 0x0, no pixels.
  Image(Image&& other) noexcept
      : size_(std::exchange(other.size_, Size{})), pixels_(std::exchange(other.pixels_, {})) {}
  Image& operator=(Image&& other) noexcept {
    size_ = std::exchange(other.size_, Size{});
    pixels_ = std::exchange(other.pixels_, {});
    return *this;
  }
  Image& operator=(const Image&) = delete;
  ~Image() = default;

  [[nodiscard]] Image clone() const { return Image(*this); }

  [[nodiscard]] Size size() const { return size_; }
  [[nodiscard]] int width() const { return size_.width; }
  [[nodiscard]] int height() const { return size_.height; }
  [[nodiscard]] bool empty() const { return pixels_.empty(); }
  [[nodiscard]] bool contains(int x, int y) const {
    return x >= 0 && y >= 0 && x < size_.width && y < size_.height;
  }

  T& operator()(int x, int y) { return pixels_[index(x, y)]; }
  const T& operator()(int x, int y) const { return pixels_[index(x, y)]; }

  std::span<T> row(int y) { return pixels().subspan(index(0, y), static_cast<std::size_t>(size_.width)); }
  std::span<const T> row(int y) const {
    return pixels().subspan(index(0, y), static_cast<std::size_t>(size_.width));
  }
  std::span<T> pixels() { return pixels_; }
  std::span<const T> pixels() const { return pixels_; }

 protected:
  Image(const Image&) = default;

 private:
  [[nodiscard]] std::size_t index(int x, int y) const {
    assert(x >= 0 && y >= 0 && y < size_.height && (x < size_.width || size_.width == 0));
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(size_.width) + static_cast<std::size_t>(x);
  }

  Size size_;
  std::vector<T> pixels_;
};

/// An image whose meaning is part of its type: a DepthMap cannot be passed where a LuminanceMap is expected.
template <class Tag, class T>
class Map : public Image<T> {
 public:
  using Image<T>::Image;
  Map() = default;
  // Declared because a base whose copy constructor is merely protected would leave the implicit copy public
  // here.
  Map(Map&&) noexcept = default;
  Map& operator=(Map&&) noexcept = default;
  Map& operator=(const Map&) = delete;
  ~Map() = default;
  [[nodiscard]] Map clone() const { return Map(static_cast<const Image<T>&>(*this)); }

 private:
  explicit Map(const Image<T>& other) : Image<T>(other.clone()) {}
};

using Rgb = glm::vec3;
/// Identifies one thing in the scene: an instance of a mesh with its material. 0 is the background.
using ItemId = std::uint32_t;
inline constexpr ItemId kNoItem = 0;

/// Linear Rec.709 radiance, W/(sr m2) or scene units, unbounded above.
using RadianceMap = Map<struct RadianceTag, Rgb>;
/// Display-encoded Rec.709 code values in [0, 1] (after tone curve and transfer function).
using EncodedMap = Map<struct EncodedTag, Rgb>;
/// Luminance that reaches the eye, cd/m2, > 0.
using LuminanceMap = Map<struct LuminanceTag, float>;
/// Camera-space distance along the view axis (not along the ray), metres; +inf where nothing is hit.
using DepthMap = Map<struct DepthTag, float>;
/// World-space shading-independent (geometric) unit normal facing the camera; 0 where nothing is hit.
using NormalMap = Map<struct NormalTag, glm::vec3>;
/// Displacement of the scene point seen at a pixel, pixels per frame (x right, y down);
/// NaN where the point is behind the eye of the other frame.
using PixelFlow = Map<struct PixelFlowTag, glm::vec2>;
/// Image velocity, degrees of visual angle per second (x right, y down), finite.
using VelocityMap = Map<struct VelocityTag, glm::vec2>;
/// Just noticeable differences, >= 0 (J and Jp of the metric).
using JndMap = Map<struct JndTag, float>;
/// Probability that a viewer detects a difference, [0, 1].
using ProbabilityMap = Map<struct ProbabilityTag, float>;
/// Nonzero where selected.
using Mask = Map<struct MaskTag, std::uint8_t>;
using ItemBuffer = Map<struct ItemTag, ItemId>;

}  // namespace promenade
