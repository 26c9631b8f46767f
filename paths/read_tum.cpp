#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <glm/common.hpp>
#include <numbers>
#include <string_view>

#include "paths/curve.h"
#include "paths/limits.h"
#include "paths/read_path.h"
#include "paths/rotation.h"
#include "paths/text.h"
#include "src/core/errors.h"

namespace promenade::paths {
namespace {

struct Sample {
  double timeSeconds;
  glm::dvec3 eye;
  glm::dquat rotation;
};

constexpr std::string_view kBlank = " \t\r";

std::string_view nextWord(std::string_view& line) {
  const std::size_t begin = std::min(line.find_first_not_of(kBlank), line.size());
  line.remove_prefix(begin);
  const std::size_t end = std::min(line.find_first_of(kBlank), line.size());
  const std::string_view word = line.substr(0, end);
  line.remove_prefix(end);
  return word;
}

Sample sampleFrom(std::string_view line, const std::string& where) {
  std::array<double, 8> v{};
  for (std::size_t i = 0; i < v.size(); ++i) {
    const std::string_view word = nextWord(line);
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), v[i]);
    const double limit = i == 0 ? 1e12 : kMaxCoordinateMetres;
    if (word.empty() || error != std::errc() || end != word.data() + word.size() ||
        !(std::abs(v[i]) <= limit)) {
      throw InputError(where, "expected 8 finite numbers (timestamp tx ty tz qx qy qz qw), found " +
                                  (word.empty() ? std::to_string(i)
                                                : "'" + std::string(word.substr(0, 40)) + "' as the " +
                                                      std::to_string(i + 1) + ". value"));
    }
  }
  if (!nextWord(line).empty()) {
    throw InputError(where, "expected 8 numbers (timestamp tx ty tz qx qy qz qw), found more");
  }
  const glm::dquat vision = unitQuaternion(glm::dquat(v[7], v[4], v[5], v[6]), where);
  // From y down, looking along +z, to y up, looking along -z: half a turn about the camera's x axis.
  const glm::dquat halfTurn(0.0, 1.0, 0.0, 0.0);
  return {v[0], glm::dvec3(v[1], v[2], v[3]), vision * halfTurn};
}

std::vector<Sample> samplesFrom(std::string_view text, const std::string& where) {
  std::vector<Sample> samples;
  int lineNumber = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    ++lineNumber;
    const std::size_t first = line.find_first_not_of(kBlank);
    if (first == std::string_view::npos || line[first] == '#') continue;
    const std::string place = where + ": line " + std::to_string(lineNumber);
    samples.push_back(sampleFrom(line, place));
    if (samples.size() > 1 && !(samples.back().timeSeconds > samples[samples.size() - 2].timeSeconds)) {
      throw InputError(place, "expected a time after that of the line before, found " +
                                  exactNumber(samples.back().timeSeconds) + " s");
    }
    if (static_cast<double>(samples.size()) > kMaxFrames) {
      throw InputError(place, "expected at most " + number(kMaxFrames) + " poses, found more");
    }
  }
  if (samples.empty()) throw InputError(where, "expected at least one camera pose, found none");
  return samples;
}

}  // namespace

CameraPath parseTum(const std::string& text, const std::string& where, const ReadOptions& options) {
  const std::vector<Sample> samples = samplesFrom(text, where);
  const double fieldOfView = kDefaultVerticalFieldOfViewDegrees * (std::numbers::pi / 180.0);
  CameraPath path;
  path.framesPerSecond =
      checkedFramesPerSecond(options.framesPerSecond.value_or(kDefaultFramesPerSecond), where);
  if (samples.size() == 1) {
    path.frames.push_back({{glm::mat3_cast(samples[0].rotation), samples[0].eye}, fieldOfView});
    return path;
  }
  std::vector<double> times;
  for (const Sample& s : samples) times.push_back(s.timeSeconds - samples.front().timeSeconds);
  // Timestamps are decimal fractions: a frame that misses the last one by rounding still belongs to the walk.
  const double intervals = std::floor(times.back() * path.framesPerSecond + 1e-3);
  const int count = frameCountOf((intervals + 1.0) / path.framesPerSecond, path.framesPerSecond, where);
  for (int frame = 0; frame < count; ++frame) {
    const Location at = locate(times, frame / path.framesPerSecond);
    const Sample& from = samples[at.segment];
    const Sample& to = samples[at.segment + 1];
    path.frames.push_back(
        {{glm::mat3_cast(slerp(from.rotation, to.rotation, at.u)), glm::mix(from.eye, to.eye, at.u)},
         fieldOfView});
  }
  return path;
}

}  // namespace promenade::paths
