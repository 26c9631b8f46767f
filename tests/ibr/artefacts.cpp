#include "tests/ibr/artefacts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <glm/common.hpp>

namespace promenade::ibr::tests {
namespace {

constexpr Rgb kMagenta{1.0f, 0.0f, 1.0f};
constexpr Rgb kYellow{1.0f, 1.0f, 0.0f};
constexpr Rgb kBlue{0.0f, 0.0f, 1.0f};

}  // namespace

void saveForTheEye(const RadianceMap& image, const std::string& name) {
  std::ofstream file(testing::TempDir() + name + ".ppm", std::ios::binary);
  file << "P6\n" << image.width() << " " << image.height() << "\n255\n";
  for (const Rgb& radiance : image.pixels()) {
    for (int c = 0; c < 3; ++c) {
      file.put(static_cast<char>(
          std::lround(255.0f * std::pow(glm::clamp(radiance[c], 0.0f, 1.0f), 1.0f / 2.2f))));
    }
  }
}

RadianceMap paintInvalid(const Warped& warped) {
  RadianceMap image = warped.diffuse.clone();
  for (std::size_t i = 0; i < image.pixels().size(); ++i) {
    Rgb& pixel = image.pixels()[i];
    switch (warped.validity.pixels()[i]) {
      case Validity::kValid:
        break;
      case Validity::kUndersampled:
        pixel = kYellow;
        break;
      case Validity::kOutside:
        pixel = kBlue;
        break;
      default:
        pixel = kMagenta;
        break;
    }
  }
  return image;
}

RadianceMap paintHoles(const Blended& blended) {
  RadianceMap image = blended.frame.diffuse.clone();
  for (std::size_t i = 0; i < image.pixels().size(); ++i) {
    if (blended.holes.pixels()[i] != 0) image.pixels()[i] = kMagenta;
  }
  return image;
}

RadianceMap difference(const RadianceMap& a, const RadianceMap& b, float gain) {
  RadianceMap image(a.size());
  for (std::size_t i = 0; i < image.pixels().size(); ++i) {
    image.pixels()[i] = Rgb(0.5f) + gain * (a.pixels()[i] - b.pixels()[i]);
  }
  return image;
}

}  // namespace promenade::ibr::tests
