#pragma once
// Internal: numbers of the file, checked for range, and typed access to extension objects.

#include <cmath>
#include <glm/vec3.hpp>
#include <limits>
#include <string>
#include <vector>

#include "src/scene/gltf.h"

namespace promenade::scene {

/// Beyond this, products of coordinates overflow in single precision.
inline constexpr double kLargestCoordinate = 1e15;

/// JSON numbers are doubles; the scene is in single precision. Throws InputError beyond its range.
[[nodiscard]] inline float toFloat(const Gltf& gltf, double value, const std::string& place) {
  if (!(std::abs(value) <= static_cast<double>(std::numeric_limits<float>::max()))) {
    gltf.fail(place, "the number is out of range");
  }
  return static_cast<float>(value);
}

/// `value` limited to [low, high], with a warning if that changes it.
[[nodiscard]] inline float limited(float value, float low, float high, const std::string& place,
                                   Warnings& warnings) {
  if (value >= low && value <= high) {
    return value;
  }
  const float result = value < low ? low : high;
  warnings.add(place + ": " + std::to_string(value) + " is out of range, " + std::to_string(result) +
               " is taken");
  return result;
}

/// An extension object, or part of one. Absent members give the fallback; types were checked with the JSON.
class Fields {
 public:
  Fields(const Gltf& gltf, const tinygltf::Value* object, std::string place)
      : gltf_(&gltf), object_(object), place_(std::move(place)) {}

  [[nodiscard]] explicit operator bool() const { return object_ != nullptr; }
  [[nodiscard]] const std::string& place() const { return place_; }
  [[nodiscard]] std::string place(const char* key) const { return place_ + '.' + key; }

  [[nodiscard]] const tinygltf::Value* find(const char* key) const {
    return object_ != nullptr && object_->IsObject() && object_->Has(key) ? &object_->Get(key) : nullptr;
  }
  [[nodiscard]] Fields object(const char* key) const { return {*gltf_, find(key), place(key)}; }
  [[nodiscard]] float number(const char* key, float fallback) const {
    const tinygltf::Value* value = find(key);
    return value != nullptr && value->IsNumber() ? toFloat(*gltf_, value->GetNumberAsDouble(), place(key))
                                                 : fallback;
  }
  [[nodiscard]] int index(const char* key, int fallback) const {
    const tinygltf::Value* value = find(key);
    return value != nullptr && value->IsInt() ? value->GetNumberAsInt() : fallback;
  }
  /// Throws InputError if the array has another length.
  template <class Vector>
  [[nodiscard]] Vector vector(const char* key, Vector fallback) const {
    const tinygltf::Value* value = find(key);
    if (value == nullptr) {
      return fallback;
    }
    if (value->ArrayLen() != static_cast<std::size_t>(Vector::length())) {
      gltf_->fail(place(key), "expected " + std::to_string(Vector::length()) + " numbers, found " +
                                  std::to_string(value->ArrayLen()));
    }
    for (int i = 0; i < Vector::length(); ++i) {
      fallback[i] = toFloat(*gltf_, value->Get(i).GetNumberAsDouble(), place(key));
    }
    return fallback;
  }

 private:
  const Gltf* gltf_;
  const tinygltf::Value* object_;
  std::string place_;
};

[[nodiscard]] inline Fields extension(const Gltf& gltf, const tinygltf::ExtensionMap& extensions,
                                      const char* name, const std::string& place) {
  const auto found = extensions.find(name);
  return {gltf, found == extensions.end() ? nullptr : &found->second, place + ".extensions." + name};
}

}  // namespace promenade::scene
