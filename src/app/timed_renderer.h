#pragma once

#include <chrono>
#include <functional>
#include <utility>

#include "src/core/renderer.h"

namespace promenade::app {

/// Another renderer, and how long each of its whole frames took.
class TimedRenderer final : public Renderer {
 public:
  /// `renderer` must outlive this. `rendered` gets the seconds of every call of render().
  TimedRenderer(const Renderer& renderer, std::function<void(double)> rendered)
      : renderer_(renderer), rendered_(std::move(rendered)) {}

  [[nodiscard]] Visibility visibility(const Camera& camera) const override {
    return renderer_.visibility(camera);
  }
  void retrace(Frame& frame, const Mask& mask, SampleSource source, int frameIndex) const override {
    renderer_.retrace(frame, mask, source, frameIndex);
  }
  [[nodiscard]] Frame render(const Camera& camera, int frameIndex) const override {
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    Frame frame = renderer_.render(camera, frameIndex);
    rendered_(std::chrono::duration<double>(Clock::now() - start).count());
    return frame;
  }
  [[nodiscard]] ItemTraits traits(ItemId item) const override { return renderer_.traits(item); }
  [[nodiscard]] RayCounts rayCounts() const override { return renderer_.rayCounts(); }

 private:
  const Renderer& renderer_;
  std::function<void(double)> rendered_;
};

}  // namespace promenade::app
