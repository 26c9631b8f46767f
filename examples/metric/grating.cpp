// How fast must a faint grating move for nobody to see it?
#include <aqm/metric.h>

#include <cmath>
#include <cstdio>

using namespace promenade;

int main() {
  constexpr double kPixelsPerDegree = 40.0, kCyclesPerDegree = 4.0, kContrast = 0.02;
  const Size size{256, 192};
  const LuminanceMap grey(size, 100.0f);  // cd/m2
  LuminanceMap grating(size);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const double phase = 2.0 * M_PI * kCyclesPerDegree * x / kPixelsPerDegree;
      grating(x, y) = static_cast<float>(100.0 * (1.0 + kContrast * std::sin(phase)));
    }
  }
  aqm::Settings settings = aqm::aqm(kPixelsPerDegree);
  settings.eye = aqm::Eye::kFixating;                           // an eye that does not follow
  for (const float speed : {0.0f, 1.0f, 5.0f, 20.0f, 80.0f}) {  // degrees per second
    const VelocityMap velocity(size, glm::vec2(speed, 0.0f));
    const aqm::Result result = aqm::compare(grating, grey, velocity, settings);
    std::printf("%4.0f deg/s: visible on %5.1f%% of the pixels\n", speed,
                aqm::percentVisible(result.probability, {}));
  }
}
