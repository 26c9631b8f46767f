#pragma once
// The metric straight from its definition (docs/method.md): double precision, Fourier transforms by their
// sums, every speed level, one loop per formula, nothing shared with the library. For images of a few pixels.

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "aqm/metric.h"

namespace promenade::aqm::tests {

class MetricByDefinition {
 public:
  MetricByDefinition(const LuminanceMap& test, const LuminanceMap& reference, const VelocityMap& velocity,
                     double ppd)
      : width_(test.width()), height_(test.height()), ppd_(ppd) {
    bands_ = std::max(2, static_cast<int>(std::ceil(std::log2(ppd) - 1e-9)));
    margin_ = 1 << (bands_ - 1);
    paddedWidth_ = paddedLength(width_);
    paddedHeight_ = paddedLength(height_);
    double sum = 0.0;
    for (const LuminanceMap* map : {&test, &reference}) {
      for (const float value : map->pixels()) {
        sum += static_cast<double>(value);
      }
    }
    const double adaptation = sum / (2.0 * width_ * height_);
    const Spectrum testSpectrum = transform(test, adaptation);
    const Spectrum referenceSpectrum = transform(reference, adaptation);
    powers_.assign(static_cast<std::size_t>(width_) * height_, 0.0);
    for (int band = 1; band <= bands_ + 1; ++band) {
      for (int l = 0; l < (band > bands_ ? 1 : 6); ++l) {
        const std::vector<double> a = response(testSpectrum, band, l, velocity);
        const std::vector<double> b = response(referenceSpectrum, band, l, velocity);
        const std::vector<double> elevationA = elevation(a, band);
        const std::vector<double> elevationB = elevation(b, band);
        for (std::size_t i = 0; i < powers_.size(); ++i) {
          powers_[i] += std::pow(std::abs(a[i] - b[i]) / std::min(elevationA[i], elevationB[i]), 3.5);
        }
      }
    }
  }

  [[nodiscard]] double jnd(int x, int y) const { return std::pow(powers_[at(x, y)], 1.0 / 3.5); }

  [[nodiscard]] double pooledJnd(int x, int y) const {
    const double sigma = 0.5 * ppd_;
    const int radius = static_cast<int>(3.0 * sigma + 0.5);
    double sum = 0.0;
    for (int j = std::max(0, y - radius); j <= std::min(height_ - 1, y + radius); ++j) {
      for (int i = std::max(0, x - radius); i <= std::min(width_ - 1, x + radius); ++i) {
        sum += gauss(i - x, sigma, radius) * gauss(j - y, sigma, radius) * powers_[at(i, j)];
      }
    }
    return std::pow(2.0 * pi * 0.25 * sum, 1.0 / 3.5);
  }

 private:
  using Complex = std::complex<double>;
  using Spectrum = std::vector<Complex>;
  static constexpr double pi = std::numbers::pi;

  [[nodiscard]] std::size_t at(int x, int y) const { return static_cast<std::size_t>(y) * width_ + x; }

  [[nodiscard]] int paddedLength(int length) const {
    const int unit = 1 << (bands_ - 2);
    for (int padded = unit;; padded += unit) {
      int rest = padded / unit;
      for (const int prime : {2, 3, 5}) {
        while (rest % prime == 0) rest /= prime;
      }
      if (rest == 1 && padded >= length + 2 * margin_) return padded;
    }
  }

  static int reflect(int index, int count) {
    while (index < 0 || index >= count) {
      index = index < 0 ? -1 - index : 2 * count - 1 - index;
    }
    return index;
  }

  static double gauss(int t, double sigma, int radius) {
    double sum = 0.0;
    for (int i = -radius; i <= radius; ++i) sum += std::exp(-i * i / (2.0 * sigma * sigma));
    return std::exp(-t * t / (2.0 * sigma * sigma)) / sum;
  }

  /// sum_n values[n] exp(sign 2 pi i n m / N) along rows, then along columns.
  [[nodiscard]] Spectrum fourier(Spectrum values, int sign) const {
    for (const bool alongRows : {true, false}) {
      const int length = alongRows ? paddedWidth_ : paddedHeight_;
      const int lines = alongRows ? paddedHeight_ : paddedWidth_;
      Spectrum result(values.size());
      Spectrum roots;
      for (int n = 0; n < length; ++n) roots.push_back(std::polar(1.0, sign * 2.0 * pi * n / length));
      for (int line = 0; line < lines; ++line) {
        const auto place = [&](int n) {
          return static_cast<std::size_t>(alongRows ? line * paddedWidth_ + n : n * paddedWidth_ + line);
        };
        for (int m = 0; m < length; ++m) {
          for (int n = 0; n < length; ++n) {
            result[place(m)] += values[place(n)] * roots[static_cast<std::size_t>((n * m) % length)];
          }
        }
      }
      values = std::move(result);
    }
    return values;
  }

  [[nodiscard]] Spectrum transform(const LuminanceMap& luminance, double adaptation) const {
    const auto cone = [](double l) { return l / (l + 12.6 * std::pow(l, 0.63)); };
    const double rm = cone(adaptation);
    Spectrum padded(static_cast<std::size_t>(paddedWidth_) * paddedHeight_);
    for (int y = 0; y < paddedHeight_; ++y) {
      for (int x = 0; x < paddedWidth_; ++x) {
        const double l =
            static_cast<double>(luminance(reflect(x - margin_, width_), reflect(y - margin_, height_)));
        padded[static_cast<std::size_t>(y) * paddedWidth_ + x] = (cone(l) - rm) / (0.37 * rm * (1.0 - rm));
      }
    }
    return fourier(padded, -1);
  }

  static double mesa(double f, double h) {
    return 0.5 * (1.0 + std::cos(pi * std::clamp((f - h + h / 3.0) / (2.0 * h / 3.0), 0.0, 1.0)));
  }

  [[nodiscard]] double squaredFilter(int ix, int iy, int band, int l) const {
    const auto frequency = [](int i, int n) { return static_cast<double>(2 * i < n ? i : i - n) / n; };
    const double fx = frequency(ix, paddedWidth_);
    const double fy = frequency(iy, paddedHeight_);
    const double f = std::hypot(fx, fy);
    if (band > bands_) return mesa(f, std::ldexp(1.0, -bands_));
    const double dom =
        (band == 1 ? 1.0 : mesa(f, std::ldexp(1.0, 1 - band))) - mesa(f, std::ldexp(1.0, -band));
    const auto fan = [&](double x, double y) {
      double angle = std::fmod(std::atan2(y, x) - l * pi / 6.0 + pi / 2.0, pi);
      angle = std::abs((angle < 0.0 ? angle + pi : angle) - pi / 2.0);
      return angle < pi / 6.0 ? 0.5 * (1.0 + std::cos(6.0 * angle)) : 0.0;
    };
    // -f modulo 1 of a Nyquist frequency is itself.
    const double otherX = fx == -0.5 ? fx : -fx;
    const double otherY = fy == -0.5 ? fy : -fy;
    return std::max(0.0, dom) * 0.5 * (fan(fx, fy) + fan(otherX, otherY));
  }

  static double csf(double rho, double v) {
    const double k = 6.1 + 7.3 * std::pow(std::abs(std::log10(1.7 * v / 3.0)), 3.0);
    return 1.14 * 1.7 * k * v * std::pow(2.0 * pi * 0.67 * rho, 2.0) *
           std::exp(-4.0 * pi * 0.67 * rho * (1.7 * v + 2.0) / 45.9);
  }

  [[nodiscard]] double speed(const VelocityMap& velocity, int x, int y, int band, int l) const {
    if (velocity.empty()) return 0.15;
    const double vx = static_cast<double>(velocity(x, y).x);
    const double vy = static_cast<double>(velocity(x, y).y);
    const double image = std::hypot(vx, vy);
    if (image == 0.0) return 0.15;
    const double part = (image - std::min(0.82 * image + 0.15, 80.0)) / image;
    const double seen = band > bands_ ? image : vx * std::cos(l * pi / 6.0) + vy * std::sin(l * pi / 6.0);
    return std::max(0.15, std::abs(part * seen));
  }

  [[nodiscard]] std::vector<double> response(const Spectrum& spectrum, int band, int l,
                                             const VelocityMap& velocity) const {
    const double centre = ppd_ * (band > bands_ ? std::ldexp(0.5, -bands_) : std::ldexp(4.0 / 3.0, -band));
    std::vector<double> result(powers_.size());
    for (int level = 0; level <= 10; ++level) {
      const double u = std::ldexp(0.15, level);
      Spectrum filtered = spectrum;
      for (int iy = 0; iy < paddedHeight_; ++iy) {
        for (int ix = 0; ix < paddedWidth_; ++ix) {
          const double fx =
              static_cast<double>(2 * ix < paddedWidth_ ? ix : ix - paddedWidth_) / paddedWidth_;
          const double fy =
              static_cast<double>(2 * iy < paddedHeight_ ? iy : iy - paddedHeight_) / paddedHeight_;
          const double rho = ppd_ * std::hypot(fx, fy);
          filtered[static_cast<std::size_t>(iy) * paddedWidth_ + ix] *=
              std::sqrt(std::max(0.0, squaredFilter(ix, iy, band, l))) * csf(rho, u);
        }
      }
      filtered = fourier(filtered, 1);
      for (int y = 0; y < height_; ++y) {
        for (int x = 0; x < width_; ++x) {
          const double v = speed(velocity, x, y, band, l);
          const double t = std::log2(v / 0.15);
          const double weight = std::max(0.0, 1.0 - std::abs(t - level));
          if (weight == 0.0) continue;
          const auto place = static_cast<std::size_t>(y + margin_) * paddedWidth_ + x + margin_;
          result[at(x, y)] += 1.09 * weight * csf(centre, v) / csf(centre, u) * filtered[place].real() /
                              (static_cast<double>(paddedWidth_) * paddedHeight_);
        }
      }
    }
    return result;
  }

  [[nodiscard]] std::vector<double> elevation(const std::vector<double>& response, int band) const {
    const double sigma = 0.375 * std::ldexp(1.0, band);
    const int radius = static_cast<int>(3.0 * sigma + 0.5);
    std::vector<double> kernel;
    for (int t = -radius; t <= radius; ++t) kernel.push_back(gauss(t, sigma, radius));
    const auto weight = [&](int t) { return kernel[static_cast<std::size_t>(t + radius)]; };
    std::vector<double> rows(response.size());
    std::vector<double> result(response.size());
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        for (int t = -radius; t <= radius; ++t) {
          const double r = response[at(reflect(x + t, width_), y)];
          rows[at(x, y)] += weight(t) * std::pow(1.0 + r * r * r * r, 0.25);
        }
      }
    }
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        for (int t = -radius; t <= radius; ++t) {
          result[at(x, y)] += weight(t) * rows[at(x, reflect(y + t, height_))];
        }
      }
    }
    return result;
  }

  int width_;
  int height_;
  double ppd_;
  int bands_ = 0;
  int margin_ = 0;
  int paddedWidth_ = 0;
  int paddedHeight_ = 0;
  std::vector<double> powers_;
};

}  // namespace promenade::aqm::tests
