#include "src/app/heatmap.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <span>
#include <string_view>

#include "aqm/metric.h"
#include "src/app/lettering.h"

namespace promenade::app {
namespace {

constexpr Size kSmallestPanel{512, 270};
constexpr int kLargestPanelSide = 4096;
constexpr int kLine = kLetterHeight + 6;
constexpr int kBarRows = 12;
constexpr int kGap = 8;
constexpr float kMostJnd = 8.0f;
// What --mask leaves out: a colour that neither map has.
const Rgb kExcluded(0.0f, 0.25f, 0.3f);

// How the pixels of the frames are shown.
struct Zoom {
  int enlarge = 1;
  int reduce = 1;
  explicit Zoom(Size frame)
      : enlarge(
            std::max(1, std::min(kSmallestPanel.width / frame.width, kSmallestPanel.height / frame.height))),
        reduce((std::max(frame.width, frame.height) + kLargestPanelSide - 1) / kLargestPanelSide) {}
  [[nodiscard]] int shown(int side) const { return (side + reduce - 1) / reduce * enlarge; }
};

// colourOf(x, y) for every pixel of the frame, the mean of several where it is reduced.
template <class ColourOf>
void drawPanel(EncodedMap& sheet, int left, int top, Size frame, const Zoom& zoom, const ColourOf& colourOf) {
  const int columns = zoom.shown(frame.width);
  tbb::parallel_for(0, zoom.shown(frame.height), [&](int row) {
    const int y = row / zoom.enlarge * zoom.reduce;
    for (int column = 0; column < columns; ++column) {
      const int x = column / zoom.enlarge * zoom.reduce;
      Rgb sum(0.0f);
      int count = 0;
      for (int v = y; v < std::min(y + zoom.reduce, frame.height); ++v) {
        for (int u = x; u < std::min(x + zoom.reduce, frame.width); ++u, ++count) sum += colourOf(u, v);
      }
      sheet(left + column, top + row) = sum / static_cast<float>(count);
    }
  });
}

struct Tick {
  float place;  // 0 .. 1 along the bar
  std::string_view label;
};

constexpr std::string_view kThresholdWords[] = {"CHANCE THAT A VIEWER SEES A DIFFERENCE",
                                                "ORANGE, YELLOW: VISIBLE, COUNTED ABOVE",
                                                "VIOLET: HARDLY. GREY PICTURE: NOT AT ALL"};
constexpr std::string_view kJndWords[] = {"JUST NOTICEABLE DIFFERENCES, THRESHOLDS",
                                          "RIGHT OF THE WHITE MARK: VISIBLE", "DARK PICTURE: NOT SEEN"};
constexpr std::string_view kExcludedWords = "BLUE-GREEN: LEFT OUT BY THE MASK";
// Where P = 1 - exp(-Jp^3.5) is 0.75.
constexpr float kVisibleJnd = 1.0978f;
constexpr int kLegendRows = 2 * kGap + kBarRows + 5 * kLine;

float jndPlace(float jnd) {
  return std::log2(1.0f + std::clamp(jnd, 0.0f, kMostJnd)) / std::log2(1.0f + kMostJnd);
}

// A bar with a white mark from where on differences count as visible, its numbers, and what they mean.
template <class ColourAt>
void drawLegend(EncodedMap& sheet, int left, int top, int width, const ColourAt& colourAt, float mark,
                std::span<const Tick> ticks, std::span<const std::string_view> words) {
  for (int x = 0; x < width; ++x) {
    const Rgb colour = colourAt(static_cast<float>(x) / static_cast<float>(width - 1));
    for (int y = 0; y < kBarRows; ++y) sheet(left + x, top + kGap + y) = colour;
  }
  const int markLeft = left + static_cast<int>(mark * static_cast<float>(width - 1)) - 1;
  for (int y = -4; y < kBarRows; ++y) {
    for (int x = 0; x < 3; ++x) sheet(markLeft + x, top + kGap + y) = Rgb(1.0f);
  }
  int line = top + kGap + kBarRows + 4;
  for (const Tick& tick : ticks) {
    const int centre = static_cast<int>(tick.place * static_cast<float>(width - 1));
    const int textLeft =
        std::clamp(centre - textWidth(tick.label) / 2, 0, std::max(0, width - textWidth(tick.label)));
    drawText(sheet, left + textLeft, line, tick.label);
  }
  for (const std::string_view text : words) drawText(sheet, left, line += kLine, text);
}

}  // namespace

Rgb visibilityColour(float probability, float grey) {
  constexpr float kLimit = aqm::kVisibleProbability;
  const float p = std::clamp(probability, 0.0f, 1.0f);
  if (p > kLimit) {
    return glm::mix(Rgb(0.95f, 0.4f, 0.0f), Rgb(1.0f, 1.0f, 0.4f), (p - kLimit) / (1.0f - kLimit));
  }
  return glm::mix(Rgb(grey), Rgb(0.42f, 0.22f, 0.85f), p / kLimit);
}

Rgb thresholdColour(float probability, const Rgb& picture) {
  const float grey = 0.2126f * picture.r + 0.7152f * picture.g + 0.0722f * picture.b;
  return visibilityColour(probability, 0.1f + 0.5f * grey);
}

Rgb jndColour(float jnd) {
  constexpr std::array<std::array<float, 3>, 5> kStops = {{{0.0f, 0.0f, 0.0f},
                                                           {0.34f, 0.06f, 0.43f},
                                                           {0.73f, 0.21f, 0.33f},
                                                           {0.98f, 0.55f, 0.04f},
                                                           {0.99f, 1.0f, 0.64f}}};
  const float t = jndPlace(jnd) * 4.0f;
  const auto i = static_cast<std::size_t>(std::min(t, 3.0f));
  const auto colour = [&](std::size_t k) { return Rgb(kStops[k][0], kStops[k][1], kStops[k][2]); };
  return glm::mix(colour(i), colour(i + 1), t - static_cast<float>(i));
}

Rgb jndColourOver(float jnd, float grey) {
  // Below the threshold of seeing the picture shows through.
  const float shown = std::clamp(jnd, 0.0f, 1.0f);
  return jndColour(jnd) + Rgb(grey * (1.0f - shown));
}

EncodedMap greyPicture(const LuminanceMap& luminance, float white) {
  EncodedMap picture(luminance.size());
  tbb::parallel_for(0, luminance.height(), [&](int y) {
    for (int x = 0; x < luminance.width(); ++x) {
      picture(x, y) = Rgb(std::pow(std::min(luminance(x, y) / white, 1.0f), 1.0f / 2.2f));
    }
  });
  return picture;
}

EncodedMap heatmap(const ComparedFrames& frames, const std::string& title) {
  const Size frame = frames.reference.size();
  const Zoom zoom(frame);
  const int width = std::max(kSmallestPanel.width, zoom.shown(frame.width));
  const int height = zoom.shown(frame.height);
  const int right = 2 * kGap + width;
  const int upper = kGap + 2 * kLine;
  const int lower = upper + height + kGap + kLine;
  EncodedMap sheet(3 * kGap + 2 * width, lower + height + kLegendRows, Rgb(0.0f));

  const auto isExcluded = [&](int x, int y) {
    return !frames.excluded.empty() && frames.excluded(x, y) != 0;
  };
  const auto panel = [&](int left, int top, std::string_view caption, const auto& colourOf) {
    drawText(sheet, left, top - kLine, caption);
    drawPanel(sheet, left + (width - zoom.shown(frame.width)) / 2, top, frame, zoom, colourOf);
  };
  drawText(sheet, kGap, kGap, title);
  panel(kGap, upper, "TEST", [&](int x, int y) { return frames.test(x, y); });
  panel(right, upper, "REFERENCE", [&](int x, int y) { return frames.reference(x, y); });
  const auto greyAt = [&](int x, int y) {
    const Rgb& c = frames.reference(x, y);
    return 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b;
  };
  panel(kGap, lower, "THRESHOLD MAP: WHERE A DIFFERENCE IS SEEN", [&](int x, int y) {
    return isExcluded(x, y) ? kExcluded : thresholdColour(frames.probability(x, y), frames.reference(x, y));
  });
  panel(right, lower, "JND MAP: HOW CLEARLY IT IS SEEN", [&](int x, int y) {
    return isExcluded(x, y) ? kExcluded : jndColourOver(frames.pooledJnd(x, y), 0.35f * greyAt(x, y));
  });

  const Tick percents[] = {{0.0f, "0%"}, {0.25f, "25%"}, {0.5f, "50%"}, {0.75f, "75%"}, {1.0f, "100%"}};
  drawLegend(
      sheet, kGap, lower + height, width, [](float place) { return visibilityColour(place, 0.35f); },
      aqm::kVisibleProbability, percents, kThresholdWords);
  const Tick jnds[] = {
      {0.0f, "0"}, {jndPlace(1.0f), "1"}, {jndPlace(2.0f), "2"}, {jndPlace(4.0f), "4"}, {1.0f, "8+"}};
  drawLegend(
      sheet, right, lower + height, width,
      [](float place) { return jndColour(std::exp2(place * std::log2(1.0f + kMostJnd)) - 1.0f); },
      jndPlace(kVisibleJnd), jnds, kJndWords);
  if (!frames.excluded.empty()) {
    drawText(sheet, kGap, sheet.height() - kGap - kLetterHeight, kExcludedWords);
  }
  return sheet;
}

}  // namespace promenade::app
