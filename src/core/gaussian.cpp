#include "src/core/gaussian.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace promenade {
namespace {

std::vector<float> halfKernel(double sigma) {
  const int radius = static_cast<int>(std::ceil(3.0 * sigma));
  std::vector<float> weights;
  for (int i = 0; i <= radius; ++i) {
    weights.push_back(static_cast<float>(std::exp(-0.5 * (i / sigma) * (i / sigma))));
  }
  return weights;
}

// The weighted mean of at(first..last) around `centre`.
template <class At>
Rgb mean(const std::vector<float>& kernel, int centre, int count, const At& at) {
  const int radius = static_cast<int>(kernel.size()) - 1;
  Rgb sum(0.0f);
  float weights = 0.0f;
  for (int i = std::max(centre - radius, 0); i <= std::min(centre + radius, count - 1); ++i) {
    const float weight = kernel[static_cast<std::size_t>(std::abs(i - centre))];
    sum += weight * at(i);
    weights += weight;
  }
  return sum / weights;
}

}  // namespace

RadianceMap blurred(const RadianceMap& image, double sigma) {
  if (!(sigma > 0.0)) return image.clone();
  const std::vector<float> kernel = halfKernel(sigma);
  RadianceMap rows(image.size());
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      rows(x, y) = mean(kernel, x, image.width(), [&](int i) { return image(i, y); });
    }
  }
  RadianceMap both(image.size());
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      both(x, y) = mean(kernel, y, image.height(), [&](int i) { return rows(x, i); });
    }
  }
  return both;
}

}  // namespace promenade
