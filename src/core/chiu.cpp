// Departures from the paper: blurring, limiting and smoothing are done on a grid of 64 cells across, because
// the scale varies slowly (the paper spends its time in smoothing at full resolution); what must not exceed
// white is therefore the mean of a cell, so that a lamp of a few pixels clips instead of darkening what is
// around it. The paper leaves the constant of proportionality to the user; here surroundings become middle
// grey.

#include "src/core/chiu.h"

#include <algorithm>
#include <cmath>

#include "src/core/display.h"
#include "src/core/gaussian.h"

namespace promenade {
namespace {

constexpr int kCells = 64;          // across
constexpr double kBlur = 6.0;       // cells: a tenth of the width
constexpr double kSmoothing = 1.0;  // cells
constexpr int kSmoothings = 4;      // limits that are smoothed push out their neighbours a little
constexpr float kMiddleGrey = 0.18f;
constexpr float kDarkestAverage = kMiddleGrey / 16.0f;

Size gridFor(Size picture) {
  const int columns = std::min(kCells, picture.width);
  const double rows = static_cast<double>(columns) * picture.height / picture.width;
  return {columns, std::clamp(static_cast<int>(std::lround(rows)), 1, picture.height)};
}

float finiteLuminance(const Rgb& radiance) {
  const float l = luminance(radiance);
  return std::isfinite(l) && l > 0.0f ? l : 0.0f;
}

// Mean exposed luminance of each cell, over all pictures. In double and over one picture after the other in
// each cell, so that their order changes nothing of two.
RadianceMap cellMeans(std::span<const RadianceMap* const> pictures, float exposure, Size grid) {
  const auto [width, height] = pictures.front()->size();
  RadianceMap means(grid);
  for (int row = 0; row < grid.height; ++row) {
    for (int column = 0; column < grid.width; ++column) {
      double sum = 0.0;
      double count = 0.0;
      for (int y = height * row / grid.height; y < height * (row + 1) / grid.height; ++y) {
        for (int x = width * column / grid.width; x < width * (column + 1) / grid.width; ++x) {
          double atPixel = 0.0;
          for (const RadianceMap* picture : pictures) {
            atPixel += static_cast<double>(finiteLuminance((*picture)(x, y)));
          }
          sum += atPixel;
          count += static_cast<double>(pictures.size());
        }
      }
      means(column, row) = Rgb(exposure * static_cast<float>(sum / count));
    }
  }
  return means;
}

}  // namespace

Surroundings::Surroundings(std::span<const RadianceMap* const> pictures, float exposure) {
  if (pictures.empty() || pictures.front()->empty()) return;
  const Size size = pictures.front()->size();
  const Size grid = gridFor(size);
  const RadianceMap means = cellMeans(pictures, exposure, grid);
  RadianceMap scale = blurred(means, kBlur);
  for (Rgb& value : scale.pixels()) value = Rgb(kMiddleGrey) / std::max(value.g, kDarkestAverage);
  for (int pass = 0; pass < kSmoothings; ++pass) {
    for (std::size_t i = 0; i < means.pixels().size(); ++i) {
      const float shown = means.pixels()[i].g * scale.pixels()[i].g;
      if (shown > 1.0f) scale.pixels()[i] /= shown;
    }
    scale = blurred(scale, kSmoothing);
  }
  scale_ = Image<float>(grid);
  for (std::size_t i = 0; i < means.pixels().size(); ++i) scale_.pixels()[i] = scale.pixels()[i].g;
  cellsPerPixel_ = glm::vec2(static_cast<float>(grid.width) / static_cast<float>(size.width),
                             static_cast<float>(grid.height) / static_cast<float>(size.height));
}

float Surroundings::scaleAt(glm::vec2 point) const {
  if (scale_.empty()) return 1.0f;
  const auto along = [](float cell, int count) {
    return std::clamp(cell - 0.5f, 0.0f, static_cast<float>(count - 1));
  };
  const float x = along(point.x * cellsPerPixel_.x, scale_.width());
  const float y = along(point.y * cellsPerPixel_.y, scale_.height());
  const int left = static_cast<int>(x);
  const int top = static_cast<int>(y);
  const int right = std::min(left + 1, scale_.width() - 1);
  const int bottom = std::min(top + 1, scale_.height() - 1);
  const float u = x - static_cast<float>(left);
  const float v = y - static_cast<float>(top);
  const float above = scale_(left, top) + u * (scale_(right, top) - scale_(left, top));
  const float below = scale_(left, bottom) + u * (scale_(right, bottom) - scale_(left, bottom));
  return above + v * (below - above);
}

}  // namespace promenade
