#include "aqm/passband.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace promenade::aqm {
namespace {

constexpr double kHalfTurn = std::numbers::pi;

/// An interval of angles between 0 and a quarter turn.
struct Angles {
  double least = 1.0;
  double most = 0.0;
  void include(double from, double to) {
    from = std::max(from, 0.0);
    to = std::min(to, 0.5 * kHalfTurn);
    if (from <= to) {
      *this = least > most ? Angles{from, to} : Angles{std::min(least, from), std::max(most, to)};
    }
  }
};

/// Angles of frequencies (x > 0, |y|) that the fan passes where y has the given sign.
Angles fanAngles(int orientation, int orientations, double sign) {
  Angles angles;
  if (orientation == kUnoriented || orientations == 1) {
    angles.include(0.0, kHalfTurn);
    return angles;
  }
  const double centre = kHalfTurn * orientation / orientations;
  const double width = kHalfTurn / orientations;
  for (const double turned : {centre, centre - kHalfTurn}) {
    angles.include(std::min(sign * (turned - width), sign * (turned + width)),
                   std::max(sign * (turned - width), sign * (turned + width)));
  }
  return angles;
}

}  // namespace

PassedRows passedRows(const FilterBank& filters, int band, int orientation, int column, Size padded,
                      int step) {
  const double x = static_cast<double>(column) / (padded.width * step);
  const double highest = filters.highest(band);
  const double lowest = filters.lowest(band);
  if (x > highest) {
    return {};
  }
  const double perRow = static_cast<double>(padded.height) * step;
  const int half = padded.height / 2;
  const auto rowsOf = [&](double sign) -> Interval {
    const Angles angles = fanAngles(orientation, filters.orientations(), sign);
    if (angles.least > angles.most) {
      return {};
    }
    const double steepest = angles.most > 0.4999 * kHalfTurn ? highest : x * std::tan(angles.most);
    const double outer = std::min(steepest, std::sqrt(highest * highest - x * x));
    const double inner = std::max(x * std::tan(std::min(angles.least, 0.4999 * kHalfTurn)),
                                  std::sqrt(std::max(0.0, lowest * lowest - x * x)));
    if (inner > outer) {
      return {};
    }
    return {std::max(0, static_cast<int>(inner * perRow) - 1),
            std::min(half + 1, static_cast<int>(outer * perRow) + 2)};
  };
  Interval up = rowsOf(1.0);
  Interval down = rowsOf(-1.0);
  if (2 * column == padded.width) {
    // The column has two names: what passes one of them passes.
    const bool none = up.begin >= up.end;
    const bool both = !none && down.begin < down.end;
    up = both ? Interval{std::min(up.begin, down.begin), std::max(up.end, down.end)} : (none ? down : up);
    down = up;
  }
  // Row 1 of the negative frequencies is the last one. Nyquist's row, number `half` of an even height, is
  // within reach of both.
  PassedRows rows;
  rows.positive = up;
  if (down.begin < down.end) {
    rows.negative = {padded.height - (down.end - 1), padded.height - std::max(1, down.begin) + 1};
  }
  return rows;
}

}  // namespace promenade::aqm
