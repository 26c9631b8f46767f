#include "aqm/grid.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace promenade::aqm {

int gridStep(int band, int bands) {
  const int octaves = band > bands ? bands - 2 : band - 3;
  return 1 << std::max(0, octaves);
}

Grid gridOf(const Layout& layout, int step) {
  const auto sites = [step](int pixels) { return (pixels - 1) / step + (step > 1 ? 2 : 1); };
  return {step,
          {sites(layout.image.width), sites(layout.image.height)},
          {layout.padded.width / step, layout.padded.height / step},
          layout.margin / step,
          step > 1 ? 2 : 0};
}

Reflections reflectionsOf(int pixels, int sites, int step, int count) {
  const auto at = [=](int site) {
    const int pixel = reflected(site * step, pixels);
    return Reflection{pixel / step, static_cast<float>(pixel % step) / static_cast<float>(step)};
  };
  Reflections result;
  for (int i = 0; i < count; ++i) {
    result.before.push_back(at(i - count));
    result.after.push_back(at(sites + i));
  }
  return result;
}

void addInterpolated(const Plane<float>& coarse, Plane<float>& fine) {
  tbb::parallel_for(0, fine.height(), [&](int y) {
    const float* above = coarse.row(y / 2);
    const float* below = coarse.row((y + 1) / 2);
    float* to = fine.row(y);
    for (int x = 0; x < fine.width(); ++x) {
      const int left = x / 2;
      const int right = (x + 1) / 2;
      to[x] += 0.25f * (above[left] + above[right] + below[left] + below[right]);
    }
  });
}

}  // namespace promenade::aqm
